// Which cells and points the ranks of a solid have.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/part/share_out.hpp"

using namespace abut;
using solid::Kinematics;

namespace {

/// Three boxes of 4, 6 and 8 squares.
mesh::Mesh<2> three_boxes() {
    std::vector<mesh::Mesh<2>> boxes;
    for (int i = 0; i < 3; ++i)
        boxes.push_back(
            mesh::structured_box<2>({0.0, 2.0 * i}, {4.0, 2.0 * i + 1.0}, {2 + i, 2}, mesh::CellShape::quadrangle));
    return mesh::combine<2>(boxes);
}

}  // namespace

TEST_CASE("each point has one owner, rigid bodies behind all cells, wherever they are in the mesh", "[solid][ranks]") {
    const auto mesh = three_boxes();
    const auto kinematics = GENERATE(std::vector{Kinematics::rigid, Kinematics::small, Kinematics::floating},
                                     std::vector{Kinematics::small, Kinematics::rigid, Kinematics::floating},
                                     std::vector{Kinematics::small, Kinematics::floating, Kinematics::rigid},
                                     std::vector{Kinematics::rigid, Kinematics::rigid, Kinematics::rigid},
                                     std::vector{Kinematics::small, Kinematics::small, Kinematics::small});
    constexpr int n_ranks = 3;
    std::vector<int> owner;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) owner.push_back(c % n_ranks);
    const auto n_rigid = static_cast<std::int32_t>(std::ranges::count(kinematics, Kinematics::rigid));
    std::int32_t n_deformable = 0;
    for (const std::int32_t body : mesh.cell_body)
        n_deformable += kinematics[static_cast<std::size_t>(body)] != Kinematics::rigid;
    std::map<std::int32_t, int> owner_of;
    for (int rank = 0; rank < n_ranks; ++rank) {
        const auto part = solid::part_of<2>(mesh, owner, rank, kinematics);
        const solid::PartPoints points = solid::points_of<2>(part, kinematics);
        CHECK(points.n_points == n_deformable + 3 * n_rigid);
        REQUIRE(points.number.size() == points.owner.size());
        CHECK(std::ranges::is_sorted(points.number));
        CHECK(std::ranges::count_if(points.number, [&](std::int32_t n) { return n >= n_deformable; }) == 3 * n_rigid);
        for (std::size_t i = 0; i < points.number.size(); ++i) {
            const auto [known, is_new] = owner_of.emplace(points.number[i], points.owner[i]);
            CHECK(known->second == points.owner[i]);  // the same for all ranks
        }
    }
    CHECK(std::ssize(owner_of) == n_deformable + 3 * n_rigid);
}

TEST_CASE("cells of rigid bodies weigh nothing where others are evaluated", "[solid][ranks]") {
    const auto mesh = three_boxes();  // 4, 6 and 8 cells
    const std::vector kinematics{Kinematics::small, Kinematics::rigid, Kinematics::floating};
    const std::vector<double> alike = solid::cell_weights<2>(mesh, kinematics, {});
    REQUIRE(alike.size() == 18);
    for (std::size_t c = 0; c < alike.size(); ++c) CHECK(alike[c] == (c >= 4 && c < 10 ? 0.0 : 1.0));
    std::vector<double> of_points;
    for (int i = 0; i < 4 + 8 + 3; ++i) of_points.push_back(1.0 + i);
    const std::vector<double> weights = solid::cell_weights<2>(mesh, kinematics, of_points);
    CHECK(weights[3] == 4.0);
    CHECK(weights[4] == 0.0);
    CHECK(weights[10] == 5.0);
    CHECK(weights[17] == 12.0);
    CHECK(solid::cell_weights<2>(mesh, std::vector{Kinematics::rigid, Kinematics::rigid, Kinematics::rigid}, {}).empty());
    CHECK(solid::cell_weights<2>(mesh, {}, {}).empty());
}

TEST_CASE("kinematics, weights and parts that do not fit are refused", "[solid][ranks]") {
    const auto mesh = three_boxes();
    const std::vector kinematics{Kinematics::small, Kinematics::rigid, Kinematics::floating};
    const std::vector<int> owner(18, 0);
    CHECK_THROWS_AS(solid::part_of<2>(mesh, owner, 0, std::vector{Kinematics::rigid}), BadInput);
    CHECK_THROWS_AS(solid::cell_weights<2>(mesh, kinematics, std::vector<double>(18, 1.0)), BadInput);
    CHECK_THROWS_AS(solid::points_of<2>(mesh::part_of<2>(mesh, owner, 1), kinematics), BadInput);  // no cell there
}
