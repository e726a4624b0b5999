// Boundary of the cells of a host: expected values from the geometry of a unit cube.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/surface/cell_surface.hpp"

using namespace abut;
using Catch::Matchers::Contains;

namespace {

const std::vector<Vector<3>> unit_cube = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},      {0, 0, 1},
                                          {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 0.5}};

struct Case {
    const char* name;
    std::vector<std::vector<std::int32_t>> cells;
    std::size_t n_faces;
};

/// The unit cube cut into cells of each shape.
const std::vector<Case> cubes = {
    {"a hexahedron", {{0, 1, 2, 3, 4, 5, 6, 7}}, 6},
    {"two prisms", {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}}, 8},
    {"six pyramids",
     {{0, 1, 2, 3, 8}, {4, 5, 6, 7, 8}, {0, 1, 5, 4, 8}, {1, 2, 6, 5, 8}, {2, 3, 7, 6, 8}, {3, 0, 4, 7, 8}},
     6},
    {"five tetrahedra", {{0, 1, 2, 5}, {0, 2, 3, 7}, {0, 4, 5, 7}, {2, 5, 6, 7}, {0, 2, 5, 7}}, 12}};

contact::CellSurface<3> surface_of(const std::vector<std::vector<std::int32_t>>& cells,
                                   std::vector<std::int32_t> body = {}) {
    std::vector<std::int32_t> nodes, offsets{0};
    for (const auto& cell : cells) {
        nodes.insert(nodes.end(), cell.begin(), cell.end());
        offsets.push_back(static_cast<std::int32_t>(nodes.size()));
    }
    return contact::surface_of<3>(unit_cube, {.nodes = nodes, .offsets = offsets, .body = body});
}

Vector<3> area_of(const contact::CellSurface<3>& surface, std::size_t face) {
    Vector<3> twice = Vector<3>::Zero();
    const auto begin = static_cast<std::size_t>(surface.offsets[face]),
               end = static_cast<std::size_t>(surface.offsets[face + 1]);
    for (std::size_t i = begin; i < end; ++i) {
        const auto next = i + 1 < end ? i + 1 : begin;
        const Vector<3>& a = unit_cube[static_cast<std::size_t>(surface.nodes[i])];
        const Vector<3>& b = unit_cube[static_cast<std::size_t>(surface.nodes[next])];
        twice += Vector<3>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
    }
    return 0.5 * twice;
}

}  // namespace

TEST_CASE("the surface of a unit cube has area 6, closes, and encloses 1, whatever its cells and their sense",
          "[contact][cells]") {
    const Case& given = cubes[static_cast<std::size_t>(GENERATE(0, 1, 2, 3))];
    const bool is_mirrored = GENERATE(false, true);
    CAPTURE(given.name, is_mirrored);
    auto cells = given.cells;
    if (is_mirrored)  // the same corners in the other sense
        for (auto& cell : cells) {
            const std::size_t half = cell.size() == 8 || cell.size() == 6 ? cell.size() / 2 : cell.size() - 1;
            std::reverse(cell.begin(), cell.begin() + static_cast<std::ptrdiff_t>(half));
            if (cell.size() == 8 || cell.size() == 6)
                std::reverse(cell.begin() + static_cast<std::ptrdiff_t>(half), cell.end());
        }
    const auto surface = surface_of(cells);
    REQUIRE(surface.body.size() == given.n_faces);
    double area = 0.0, volume = 0.0;
    Vector<3> sum = Vector<3>::Zero();
    for (std::size_t face = 0; face < surface.body.size(); ++face) {
        const Vector<3> of_face = area_of(surface, face);
        area += of_face.norm();
        sum += of_face;
        volume += of_face.dot(
                      unit_cube[static_cast<std::size_t>(surface.nodes[static_cast<std::size_t>(surface.offsets[face])])]) /
                  3.0;
    }
    CHECK(area == Approx(6.0).epsilon(1e-14));
    CHECK(sum.norm() < 1e-14);
    CHECK(volume == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("depth is half the height of the cell behind a face", "[contact][cells]") {
    for (const double depth : surface_of(cubes[0].cells).depth) CHECK(depth == Approx(0.5).epsilon(1e-14));
    // Corner tetrahedra: 1/sqrt(3) would be over the inner face, 1 over the outer ones.
    for (const double depth : surface_of(cubes[3].cells).depth) CHECK(depth == Approx(0.5).epsilon(1e-14));
    const std::vector<Vector<2>> triangle = {{0, 0}, {3, 0}, {0, 4}};
    const std::vector<std::int32_t> nodes = {0, 1, 2}, offsets = {0, 3};
    const auto plane = contact::surface_of<2>(triangle, {.nodes = nodes, .offsets = offsets});
    CHECK(plane.nodes == std::vector<std::int32_t>{0, 1, 1, 2, 2, 0});
    const std::array<double, 3> heights = {4.0, 2.4, 3.0};
    for (std::size_t i = 0; i < 3; ++i) CHECK(plane.depth[i] == Approx(0.5 * heights[i]).epsilon(1e-14));
    CHECK(plane.cell == std::vector<std::int32_t>{0, 0, 0});
}

TEST_CASE("faces of a plane run so that their body lies to the left", "[contact][cells]") {
    const std::vector<Vector<2>> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<std::int32_t> nodes = {0, 3, 2, 1}, offsets = {0, 4};  // clockwise
    const auto surface = contact::surface_of<2>(square, {.nodes = nodes, .offsets = offsets});
    REQUIRE(surface.body.size() == 4);
    for (std::size_t face = 0; face < 4; ++face) {
        const Vector<2> from = square[static_cast<std::size_t>(surface.nodes[2 * face])],
                        along = square[static_cast<std::size_t>(surface.nodes[2 * face + 1])] - from,
                        to_middle = Vector<2>(0.5, 0.5) - from;
        CHECK(along[0] * to_middle[1] - along[1] * to_middle[0] == Approx(0.5));
    }
}

TEST_CASE("cells that cannot be are refused by their number", "[contact][cells]") {
    CHECK_THROWS_WITH(surface_of({{0, 1, 2, 99}}), Contains("cell 0 has the node 99; there are 9"));
    CHECK_THROWS_WITH(surface_of({{0, 1, 2}}), Contains("cell 0 has 3 corners; 4, 5, 6 and 8"));
    CHECK_THROWS_WITH(surface_of({{0, 1, 2, 3}}), Contains("cell 0 has no volume"));
    CHECK_THROWS_WITH(surface_of({{0, 1, 2, 5}, {0, 2, 5, 7}, {0, 2, 5, 8}}), Contains("shares a face with cells 0 and 1"));
    CHECK_THROWS_WITH(surface_of({{0, 1, 2, 5}, {0, 2, 5, 7}}, {0, 1}),
                      Contains("cell 1 of body 1 shares a face with cell 0 of body 0. Give each body nodes of its own"));
    CHECK_THROWS_WITH(surface_of({{0, 1, 2, 5}}, {0, 1}), Contains("body has 2 entries for 1 cells"));
    CHECK_THROWS_AS(surface_of({{0, 1, 2, 5}}, {-1}), BadInput);
}
