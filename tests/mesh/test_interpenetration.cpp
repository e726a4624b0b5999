#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

#include "abut/mesh/interpenetration.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes.hpp"

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

}  // namespace

TEMPLATE_TEST_CASE_SIG("overlapping cells are listed deepest first, one of each body, whatever the broad phase", "[mesh][interpenetration]", ((int Dim), Dim), 2, 3) {
    const auto broad_phase = GENERATE(geometry::BroadPhase::embree, geometry::BroadPhase::fcl, geometry::BroadPhase::brute_force);
    Vector<Dim> corner = Vector<Dim>::Constant(0.3);  // so that cells of different sizes lie in each other
    corner[0] = 0.7;
    const auto mesh = both<Dim>(cube<Dim>(Vector<Dim>::Zero(), 2, simplex<Dim>(), "low"), cube<Dim>(corner, 3, simplex<Dim>(), "high"));
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

TEMPLATE_TEST_CASE_SIG("one cell pushed into another by d has the depth d", "[mesh][interpenetration]", ((int Dim), Dim), 2, 3) {
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

TEMPLATE_TEST_CASE_SIG("a body wholly inside another is found, though their surfaces are far apart", "[mesh][interpenetration]", ((int Dim), Dim), 2, 3) {
    const auto big = cube<Dim>(Vector<Dim>::Zero(), 4, simplex<Dim>(), "big");
    std::array<int, Dim> one;
    one.fill(1);
    const Vector<Dim> lower = Vector<Dim>::Constant(0.45), upper = Vector<Dim>::Constant(0.55);
    const auto mesh = both<Dim>(big, structured_box<Dim>(lower, upper, one, simplex<Dim>(), "small"));
    CHECK_FALSE(find_interpenetrations<Dim>(mesh).empty());
}

TEST_CASE("discs that overlap are refused by name, cells, depth and remedy", "[mesh][interpenetration]") {
    const auto mesh = both<2>(disc({.centre = {0.0, 0.0}, .size = 0.3, .name = "left"}), disc({.centre = {1.9, 0.0}, .size = 0.3, .variant = 1, .name = "right"}));
    const auto worst = find_interpenetrations<2>(mesh).front();
    const auto cells = std::to_string(mesh.cell_label[worst.cells[0]]) + "|" + std::to_string(mesh.cell_label[worst.cells[1]]);
    CHECK_THROWS_WITH(check_apart<2>(mesh, "Raise the gap."),
                      Catch::Contains("'left' and 'right'") && Catch::Contains("cells " + cells) && Catch::Contains("0 m is allowed") && Catch::Contains("Raise the gap."));
    CHECK_THROWS_AS(check_apart<2>(mesh), MeshError);
}

TEST_CASE("cells of one body are never compared", "[mesh][interpenetration]") {
    CHECK(find_interpenetrations<3>(cube<3>(Vector<3>::Zero(), 3, CellShape::tetrahedron, "alone")).empty());
}

}  // namespace abut::mesh
