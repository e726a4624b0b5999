#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/shapes.hpp"

namespace abut::mesh {
namespace {

template <int Dim>
CellShape simplex() {
    return Dim == 2 ? CellShape::triangle : CellShape::tetrahedron;
}

/// A cube of edge length 1 with n cells along each edge, its lower corner at `corner`.
template <int Dim>
Mesh<Dim> cube(const Vector<Dim>& corner, int n, CellShape shape, const std::string& name) {
    std::array<int, Dim> counts;
    counts.fill(n);
    return structured_box<Dim>(corner, corner + Vector<Dim>::Ones(), counts, shape, name);
}

template <int Dim>
CellShape brick() {
    return Dim == 2 ? CellShape::quadrangle : CellShape::hexahedron;
}

template <int Dim>
Mesh<Dim> both(const Mesh<Dim>& body_1, const Mesh<Dim>& body_2) {
    return combine<Dim>(std::array{body_1, body_2});
}

template <int Dim>
std::vector<Vector<Dim>> points_of(const Mesh<Dim>& mesh, std::int32_t cell) {
    std::vector<Vector<Dim>> points;
    for (const std::int32_t vertex : mesh.cell_vertices[cell])
        points.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
    return points;
}

/// Room between two simplices along one direction, either way; negative where they interlock.
template <int Dim>
double room_along(const Vector<Dim>& direction, const std::vector<Vector<Dim>>& a, const std::vector<Vector<Dim>>& b) {
    const auto range = [&](const std::vector<Vector<Dim>>& points) {
        double lower = direction.dot(points[0]), upper = lower;
        for (const auto& p : points) {
            lower = std::min(lower, direction.dot(p));
            upper = std::max(upper, direction.dot(p));
        }
        return std::pair(lower, upper);
    };
    const auto [lower_a, upper_a] = range(a);
    const auto [lower_b, upper_b] = range(b);
    return std::max(lower_b - upper_a, lower_a - upper_b) / direction.norm();
}

/// Separating axes: the room along all normals of edges (2D), of faces and of pairs of edges (3D). Negative: the depth.
template <int Dim>
double largest_room(const std::vector<Vector<Dim>>& a, const std::vector<Vector<Dim>>& b) {
    std::vector<Vector<Dim>> edges, axes;
    for (const auto* points : {&a, &b})
        for (std::size_t i = 0; i < points->size(); ++i)
            for (std::size_t k = 0; k < i; ++k) edges.push_back((*points)[i] - (*points)[k]);
    if constexpr (Dim == 2) {
        for (const auto& e : edges) axes.push_back({e.y(), -e.x()});
    } else {
        for (const auto& e : edges)
            for (const auto& f : edges)
                if (const Vector<3> axis = e.cross(f); axis.norm() > 1e-9) axes.push_back(axis);
    }
    double largest = -std::numeric_limits<double>::infinity();
    for (const auto& axis : axes) largest = std::max(largest, room_along<Dim>(axis, a, b));
    return largest;
}

Mesh<3> tetrahedron(const std::vector<Vector<3>>& corners, const std::string& name) {
    CellSoup<3> soup;
    soup.name = name;
    soup.vertices = corners;
    if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) < 0.0)
        std::swap(soup.vertices[2], soup.vertices[3]);
    soup.cell_shape = {CellShape::tetrahedron};
    soup.cell_vertices.append(std::array{0, 1, 2, 3});
    soup.cell_body = {0};
    soup.body_names = {name};
    return build_mesh(std::move(soup));
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("overlapping cells are listed deepest first, one of each body, whatever the broad phase",
                       "[mesh][interpenetration]", ((int Dim), Dim), 2, 3) {
    const auto broad_phase = GENERATE(from_range(geometry::broad_phases()));
    Vector<Dim> corner = Vector<Dim>::Constant(0.3);  // so that cells of different sizes lie in each other
    corner[0] = 0.7;
    const auto mesh =
        both<Dim>(cube<Dim>(Vector<Dim>::Zero(), 2, simplex<Dim>(), "low"), cube<Dim>(corner, 3, simplex<Dim>(), "high"));
    const auto found = find_interpenetrations<Dim>(mesh, broad_phase);
    REQUIRE(found.size() > 2);
    CHECK(found.front().depth > found.back().depth);
    CHECK(found.front().bodies == std::array<std::int32_t, 2>{0, 1});
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(mesh.cell_body[found[i].cells[0]] == 0);
        CHECK(mesh.cell_body[found[i].cells[1]] == 1);
        CHECK(found[i].depth <= (i == 0 ? 1.0 : found[i - 1].depth));
    }
}

TEMPLATE_TEST_CASE_SIG("the cells that are found are those that no axis separates", "[mesh][interpenetration]",
                       ((int Dim), Dim), 2, 3) {
    Vector<Dim> corner = Vector<Dim>::Constant(0.31);
    corner[0] = 0.73;
    const auto mesh =
        both<Dim>(cube<Dim>(Vector<Dim>::Zero(), 2, simplex<Dim>(), "low"), cube<Dim>(corner, 3, simplex<Dim>(), "high"));
    std::vector<std::array<std::int32_t, 2>> expected;
    std::vector<double> depths;
    for (std::int32_t a = 0; a < mesh.n_cells(); ++a)
        for (std::int32_t b = 0; b < mesh.n_cells(); ++b)
            if (mesh.cell_body[a] == 0 && mesh.cell_body[b] == 1)
                if (const double depth = -largest_room(points_of(mesh, a), points_of(mesh, b)); depth > 2e-6) {
                    expected.push_back({a, b});
                    depths.push_back(depth);
                }
    for (const auto broad_phase : geometry::broad_phases()) {
        auto found = find_interpenetrations<Dim>(mesh, broad_phase);
        std::ranges::sort(found, {}, &Interpenetration::cells);
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            CHECK(found[i].cells == expected[i]);
            CHECK(found[i].depth == Approx(depths[i]).margin(1e-6));
        }
    }
}

TEST_CASE("cells that touch edge to edge, crossed, do not overlap, and a little further they do",
          "[mesh][interpenetration]") {
    // The upper edge of one tetrahedron runs along x, the lower edge of the other across it; turned about z and in space.
    const double gap = GENERATE(0.0, 1e-9, -1e-9, -1e-3);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (int trial = 0; trial < 100; ++trial) {
        CAPTURE(gap, trial);
        const double angle = trial == 0 ? 0.5 * std::numbers::pi : std::numbers::pi * (0.5 + 0.4 * number(random)),
                     along = 0.8 * number(random);
        const Vector<3> across(std::cos(angle), std::sin(angle), 0.0), middle(along, 0.0, gap);
        const Matrix<3> turn = rotation_about(Vector<3>(number(random), number(random), 1.0).normalized(),
                                              trial == 0 ? 0.0 : 3.0 * number(random));
        std::vector<Vector<3>> low = {{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {0, -1, -1}};
        std::vector<Vector<3>> high = {middle - across, middle + across, middle + Vector<3>(-across.y(), across.x(), 1),
                                       middle + Vector<3>(across.y(), -across.x(), 1)};
        for (auto* points : {&low, &high})
            for (Vector<3>& x : *points) x = turn * x;
        const auto mesh = both<3>(tetrahedron(low, "low"), tetrahedron(high, "high"));
        const auto found = find_interpenetrations<3>(mesh);
        CHECK(found.size() == (gap < -1e-6 ? 1 : 0));
        if (!found.empty()) CHECK(found[0].depth == Approx(-gap).epsilon(1e-6));
    }
}

TEMPLATE_TEST_CASE_SIG("one cell pushed into another by d has the depth d", "[mesh][interpenetration]", ((int Dim), Dim), 2,
                       3) {
    const double depth = GENERATE(1e-4, 0.01, 0.3);
    const auto mesh = both<Dim>(cube<Dim>(Vector<Dim>::Zero(), 1, brick<Dim>(), "low"),
                                cube<Dim>((1.0 - depth) * Vector<Dim>::UnitX(), 1, brick<Dim>(), "high"));
    const auto found = find_interpenetrations<Dim>(mesh);
    REQUIRE(found.size() == 1);
    CHECK(found[0].depth == Approx(depth).epsilon(1e-5).margin(1e-6));
}

TEMPLATE_TEST_CASE_SIG("bodies that touch or are apart do not overlap", "[mesh][interpenetration]", ((int Dim), Dim), 2, 3) {
    const double gap = GENERATE(0.0, -1e-8, 1e-9, 0.1);  // -1e-8 is within the tolerance of 1e-6 of a cell
    const auto mesh = both<Dim>(cube<Dim>(Vector<Dim>::Zero(), 3, simplex<Dim>(), "low"),
                                cube<Dim>((1.0 + gap) * Vector<Dim>::UnitX(), 4, simplex<Dim>(), "high"));
    CHECK(find_interpenetrations<Dim>(mesh).empty());
    CHECK_NOTHROW(check_apart<Dim>(mesh));
}

TEMPLATE_TEST_CASE_SIG("a body wholly inside another is found, though their surfaces are far apart",
                       "[mesh][interpenetration]", ((int Dim), Dim), 2, 3) {
    const auto big = cube<Dim>(Vector<Dim>::Zero(), 4, simplex<Dim>(), "big");
    std::array<int, Dim> one;
    one.fill(1);
    const Vector<Dim> lower = Vector<Dim>::Constant(0.45), upper = Vector<Dim>::Constant(0.55);
    const auto mesh = both<Dim>(big, structured_box<Dim>(lower, upper, one, simplex<Dim>(), "small"));
    CHECK_FALSE(find_interpenetrations<Dim>(mesh).empty());
}

TEST_CASE("discs that overlap are refused by name, cells, depth and remedy", "[mesh][interpenetration]") {
    const auto mesh = both<2>(disc({.centre = {0.0, 0.0}, .size = 0.3, .name = "left"}),
                              disc({.centre = {1.9, 0.0}, .size = 0.3, .variant = 1, .name = "right"}));
    const auto worst = find_interpenetrations<2>(mesh).front();
    const auto cells =
        std::to_string(mesh.cell_label[worst.cells[0]]) + "|" + std::to_string(mesh.cell_label[worst.cells[1]]);
    CHECK_THROWS_WITH(check_apart<2>(mesh, "Raise the gap."),
                      Catch::Contains("'left' and 'right'") && Catch::Contains("cells " + cells) &&
                          Catch::Contains("0 m is allowed") && Catch::Contains("Raise the gap."));
    CHECK_THROWS_AS(check_apart<2>(mesh), MeshError);
}

TEST_CASE("cells of one body are never compared", "[mesh][interpenetration]") {
    CHECK(find_interpenetrations<3>(cube<3>(Vector<3>::Zero(), 3, CellShape::tetrahedron, "alone")).empty());
}

TEST_CASE("a search for overlapping cells ends at so many of two bodies, and says that there may be more",
          "[mesh][interpenetration]") {
    const auto mesh = both<3>(cube<3>(Vector<3>::Zero(), 4, CellShape::tetrahedron, "low"),
                              cube<3>(Vector<3>::Constant(0.1), 4, CellShape::tetrahedron, "high"));
    REQUIRE(find_interpenetrations<3>(mesh).size() > 1000);
    const auto few = find_interpenetrations<3>(mesh, geometry::BroadPhase::automatic, {}, enough_interpenetrations);
    CHECK(std::ssize(few) == enough_interpenetrations.of_two_bodies);
    CHECK(std::ranges::is_sorted(few, std::ranges::greater{}, &Interpenetration::depth));
    CHECK(find_interpenetrations<3>(mesh, geometry::BroadPhase::automatic, {}, {.in_all = 7}).size() == 7);
    CHECK_THROWS_WITH(check_apart<3>(mesh), Catch::Contains("'low' and 'high'") &&
                                                Catch::Contains("100 pairs of cells or more overlap") &&
                                                Catch::Contains("of those that were looked at"));
}

}  // namespace abut::mesh
