#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

#include "abut/mesh/quality.hpp"
#include "abut/mesh/shapes/fill.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"
#include "mesh/laws.hpp"

namespace {

using namespace abut;
using namespace abut::mesh;

/// The triangles around a box of 1 x 2 x 3 m far from the origin: volume 6, surface 22.
SurfaceMesh box_of_triangles() {
    return boundary_of(structured_box<3>({100.0, 0.0, 0.0}, {101.0, 2.0, 3.0}, {3, 4, 5}, CellShape::tetrahedron));
}

}  // namespace

TEST_CASE("a closed surface is filled: its volume, its triangles, and the laws of a mesh", "[mesh][fill]") {
    const SurfaceMesh surface = box_of_triangles();
    const Mesh<3> mesh = fill(surface, {.size = 0.5, .name = "brick"});
    CHECK(std::accumulate(mesh.cell_measure.begin(), mesh.cell_measure.end(), 0.0) == Approx(6.0).epsilon(1e-12));
    CHECK(mesh.boundary_faces.size() == static_cast<std::size_t>(surface.faces.size()));
    double area = 0.0;
    for (const std::int32_t face : mesh.group("boundary").faces) area += mesh.face_measure[static_cast<std::size_t>(face)];
    CHECK(area == Approx(22.0).epsilon(1e-12));
    CHECK(mesh.body_names == std::vector<std::string>{"brick"});
    test::check_closed_cells(mesh);
    test::check_two_sides(mesh);
}

TEST_CASE("smaller cells fill a surface with more of them", "[mesh][fill]") {
    const SurfaceMesh surface = box_of_triangles();
    CHECK(fill(surface, {.size = 0.2}).n_cells() > 2 * fill(surface, {.size = 1.0}).n_cells());
}

TEST_CASE("a surface in another unit is refused before it is filled, and the estimate is near what is made",
          "[mesh][fill]") {
    SurfaceMesh in_millimetres = sphere_surface({.n_subdivisions = 2});
    const auto made = fill(in_millimetres, {.size = 0.1}).n_cells();
    CHECK_THROWS_AS(fill(in_millimetres, {.size = 0.1}, {.most_cells = 0.4 * made}), MeshError);
    CHECK_NOTHROW(fill(in_millimetres, {.size = 0.1}, {.most_cells = 4.0 * made}));
    for (Vector<3>& x : in_millimetres.vertices) x *= 1000.0;
    try {
        (void)fill(in_millimetres, {.size = 0.1, .name = "ball"});
        FAIL("it is filled");
    } catch (const MeshError& error) {
        CHECK_THAT(error.what(),
                   Catch::Matchers::Contains("ball: its sizes make about 1.") &&
                       Catch::Matchers::Contains("cells, at most 5000000 are made. Raise size, see that scale"));
    }
}

TEST_CASE("what is not one closed surface of triangles is refused", "[mesh][fill]") {
    SurfaceMesh open = box_of_triangles();
    open.faces.values.resize(open.faces.values.size() - 3);
    open.faces.offsets.pop_back();
    CHECK_THROWS_AS(fill(open, {}), MeshError);
    SurfaceMesh flipped = box_of_triangles();
    std::swap(flipped.faces.values[0], flipped.faces.values[1]);
    CHECK_THROWS_AS(fill(flipped, {}), MeshError);
    const SurfaceMesh bricks = boundary_of(structured_box<3>({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, CellShape::hexahedron));
    CHECK_THROWS_AS(fill(bricks, {}), MeshError);
    const std::vector<SurfaceMesh> two{
        box_of_triangles(), boundary_of(structured_box<3>({0, 0, 0}, {1, 1, 1}, {1, 1, 1}, CellShape::tetrahedron))};
    CHECK_THROWS_AS(fill(combine(two), {}), MeshError);
    CHECK_THROWS_AS(fill(box_of_triangles(), {.size = 0.0}), MeshError);
}
