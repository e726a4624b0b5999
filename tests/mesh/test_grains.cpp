#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <vector>

#include "abut/base/disjoint_sets.hpp"
#include "abut/base/error.hpp"
#include "abut/mesh/grains.hpp"
#include "abut/mesh/shapes/shapes.hpp"

using namespace abut;
using Catch::Contains;

namespace {

template <int Dim>
mesh::Mesh<Dim> box(double length, double size) {
    mesh::BoxOptions<Dim> box{.size = size};
    box.upper[0] = length;
    return mesh::box<Dim>(box);
}

template <int Dim>
std::int32_t n_grains(const std::vector<std::int32_t>& grains) {
    return *std::ranges::max_element(grains) + 1;
}

/// Parts of the grains that are connected through faces.
template <int Dim>
std::int32_t n_connected(const mesh::Mesh<Dim>& mesh, const std::vector<std::int32_t>& grains) {
    DisjointSets sets(grains.size());
    for (const auto& [first, second] : mesh.face_cells)
        if (second >= 0 && grains[static_cast<std::size_t>(first)] == grains[static_cast<std::size_t>(second)])
            sets.join(first, second);
    std::set<std::int32_t> parts;
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) parts.insert(sets.find(cell));
    return static_cast<std::int32_t>(parts.size());
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("grains are connected, have cells enough and the size that is asked for", "[mesh][grains]",
                       ((int Dim), Dim), 2, 3) {
    const auto mesh = box<Dim>(2.0, Dim == 2 ? 0.05 : 0.12);
    const double size = Dim == 2 ? 0.3 : 0.45;
    const auto grains = mesh::grains_of<Dim>(mesh, {.size = size});
    const std::int32_t n = n_grains<Dim>(grains);
    CHECK(n_connected(mesh, grains) == n);
    std::vector<std::int64_t> cells(static_cast<std::size_t>(n), 0);
    std::vector<double> measure(static_cast<std::size_t>(n), 0.0);
    std::int32_t next = 0;
    for (std::size_t cell = 0; cell < grains.size(); ++cell) {
        REQUIRE(grains[cell] <= next);  // in the order of their first cells
        next = std::max(next, grains[cell] + 1);
        ++cells[static_cast<std::size_t>(grains[cell])];
        measure[static_cast<std::size_t>(grains[cell])] += mesh.cell_measure[cell];
    }
    CHECK(*std::ranges::min_element(cells) >= mesh::least_cells_of_grain<Dim>);
    const double asked = std::pow(size, Dim);
    CHECK(n >= 0.5 * 2.0 / asked);
    CHECK(n <= 1.5 * 2.0 / asked);
    CHECK(*std::ranges::max_element(measure) <= 3.0 * asked);
}

TEMPLATE_TEST_CASE_SIG("no grain of bricks is a single layer of cells, whose centroids give no gradient", "[mesh][grains]",
                       ((int Dim), Dim), 2, 3) {
    // Where a grain takes two rows of cells, many would have one.
    std::array<int, Dim> counts;
    counts.fill(20);
    const auto mesh = mesh::structured_box<Dim>(Vector<Dim>::Zero(), Vector<Dim>::Ones(), counts,
                                                Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron);
    const double size = Dim == 2 ? 0.13 : 0.1;
    for (const std::uint32_t seed : {0u, 1u, 2u}) {
        const auto grains = mesh::grains_of<Dim>(mesh, {.size = size, .seed = seed});
        const auto n = static_cast<std::size_t>(n_grains<Dim>(grains));
        REQUIRE(n > 20);
        std::vector<std::array<std::set<long>, Dim>> layers(n);  // positions of its cells along each axis
        for (std::size_t cell = 0; cell < grains.size(); ++cell)
            for (int d = 0; d < Dim; ++d)
                layers[static_cast<std::size_t>(grains[cell])][static_cast<std::size_t>(d)].insert(
                    std::lround(40.0 * mesh.cell_centroid[cell][d]));
        for (const auto& of_grain : layers)
            for (const auto& along : of_grain) CHECK(along.size() > 1);
    }
}

TEST_CASE("the same seed gives the same grains, another one others of the same size", "[mesh][grains]") {
    const auto mesh = box<2>(2.0, 0.05);
    const auto of_seed = [&](std::uint32_t seed) { return mesh::grains_of<2>(mesh, {.size = 0.3, .seed = seed}); };
    const auto grains = of_seed(1);
    CHECK(of_seed(1) == grains);
    CHECK(of_seed(2) != grains);
    CHECK(std::abs(n_grains<2>(of_seed(2)) - n_grains<2>(grains)) <= 5);
}

TEST_CASE("a grain lies within one body", "[mesh][grains]") {
    auto one = box<2>(1.0, 0.1), other = box<2>(1.0, 0.1);
    one.name = "one", other.name = "other";
    one.body_names = {"one"}, other.body_names = {"other"};
    const std::vector<mesh::Mesh<2>> both{one, other};
    const auto mesh = mesh::combine<2>(both);
    const auto grains = mesh::grains_of<2>(mesh, {.size = 0.4});
    std::vector<std::set<std::int32_t>> bodies(static_cast<std::size_t>(n_grains<2>(grains)));
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell)
        bodies[static_cast<std::size_t>(grains[static_cast<std::size_t>(cell)])].insert(
            mesh.cell_body[static_cast<std::size_t>(cell)]);
    for (const auto& of_grain : bodies) CHECK(of_grain.size() == 1);
}

TEST_CASE("grains that leave a body whole, or of no size, are refused with what there is room for", "[mesh][grains]") {
    const auto mesh = box<2>(1.0, 0.2);
    CHECK_THROWS_WITH((mesh::grains_of<2>(mesh, {.size = 5.0})), Contains("leave each body whole"));
    CHECK_THROWS_WITH((mesh::grains_of<2>(mesh, {.size = 0.0})), Contains("the size of grains is 0 m; above 0 m is needed"));
    CHECK_THROWS_AS((mesh::grains_of<2>(mesh, {.size = std::nan("")})), BadInput);
}
