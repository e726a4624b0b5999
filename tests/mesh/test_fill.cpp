#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>
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

double volume_of(const Mesh<3>& mesh) { return std::accumulate(mesh.cell_measure.begin(), mesh.cell_measure.end(), 0.0); }

double longest_edge(const Mesh<3>& mesh, std::int32_t face) {
    const auto corners = mesh.face_vertices[face];
    double longest = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i)
        longest = std::max(longest, (mesh.vertices[static_cast<std::size_t>(corners[i])] -
                                     mesh.vertices[static_cast<std::size_t>(corners[(i + 1) % corners.size()])])
                                        .norm());
    return longest;
}

}  // namespace

TEST_CASE("a closed surface is filled: its volume, its triangles where these are kept, and the laws of a mesh",
          "[mesh][fill]") {
    const SurfaceMesh surface = box_of_triangles();
    const Mesh<3> mesh = fill(surface, {.size = 0.5, .name = "brick", .keeps_triangles = true});
    CHECK(std::accumulate(mesh.cell_measure.begin(), mesh.cell_measure.end(), 0.0) == Approx(6.0).epsilon(1e-12));
    CHECK(mesh.boundary_faces.size() == static_cast<std::size_t>(surface.faces.size()));
    double area = 0.0;
    for (const std::int32_t face : mesh.group("boundary").faces) area += mesh.face_measure[static_cast<std::size_t>(face)];
    CHECK(area == Approx(22.0).epsilon(1e-12));
    CHECK(mesh.body_names == std::vector<std::string>{"brick"});
    test::check_closed_cells(mesh);
    test::check_two_sides(mesh);
}

TEST_CASE("a surface is remeshed with cells of the size that is asked for, whatever its triangles are", "[mesh][fill]") {
    // The box has triangles of 0.6 m at most, the long box two for each side.
    const SurfaceMesh fine = box_of_triangles(),
                      coarse = boundary_of(structured_box<3>({0, 0, 0}, {3, 1, 1}, {1, 1, 1}, CellShape::tetrahedron));
    for (const auto& [surface, volume] : {std::pair{fine, 6.0}, std::pair{coarse, 3.0}})
        for (const double size : {0.5, 0.25}) {
            CAPTURE(volume, size);
            const Mesh<3> mesh = fill(surface, {.size = size, .name = "brick"});
            CHECK(mesh.report.warnings.empty());
            CHECK(volume_of(mesh) == Approx(volume).epsilon(1e-9));
            // A regular tetrahedron of this edge has a volume of size^3/(6 sqrt 2).
            const double expected = 6.0 * std::sqrt(2.0) * volume / std::pow(size, 3);
            CHECK(mesh.n_cells() > 0.4 * expected);
            CHECK(mesh.n_cells() < 2.5 * expected);
            double longest = 0.0;
            for (const std::int32_t face : mesh.boundary_faces) longest = std::max(longest, longest_edge(mesh, face));
            CHECK(longest < 1.6 * size);
            test::check_closed_cells(mesh);
            test::check_two_sides(mesh);
        }
}

TEST_CASE("cells in a surface that is remeshed have no slivers, and follow it the more closely the smaller they are",
          "[mesh][fill]") {
    const SurfaceMesh torus = torus_surface({.n_around = 40, .n_tube = 16});
    const double inside = volume_of(fill(torus, {.size = 0.2, .keeps_triangles = true}));
    double before = 1.0;
    for (const double size : {0.2, 0.1}) {
        CAPTURE(size);
        const Mesh<3> mesh = fill(torus, {.size = size});
        const MeshQuality found = quality(mesh);
        CHECK(found.smallest_inradius > 0.1 * size / (2.0 * std::sqrt(6.0)));  // that of a regular tetrahedron
        const double off = std::abs(volume_of(mesh) / inside - 1.0);
        CHECK(off < 0.6 * before);
        before = off;
        CHECK(fill(torus, {.size = size}).vertices == mesh.vertices);  // the same mesh each time
    }
}

TEST_CASE("a size that is too coarse for a surface is told of, and one that loses it keeps the triangles", "[mesh][fill]") {
    const SurfaceMesh ball = sphere_surface({.n_subdivisions = 3});
    const Mesh<3> coarse = fill(ball, {.size = 1.0}), lost = fill(ball, {.size = 5.0});
    REQUIRE(coarse.report.warnings.size() == 1);
    CHECK_THAT(coarse.report.warnings[0], Catch::Matchers::Contains("of the volume inside"));
    CHECK(volume_of(coarse) < 0.9 * 4.0 / 3.0 * std::numbers::pi);
    REQUIRE(lost.report.warnings.size() == 1);
    CHECK_THAT(lost.report.warnings[0],
               Catch::Matchers::Contains("cannot be remeshed") && Catch::Matchers::Contains("triangles stay as they are"));
    CHECK(lost.boundary_faces.size() == static_cast<std::size_t>(ball.faces.size()));
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
                       Catch::Matchers::Contains("cells, at most 5000000 are made. Raise size, give the unit of the file"));
    }
}

TEST_CASE("the cavities of a surface are left out, whether it is remeshed or keeps its triangles", "[mesh][fill]") {
    SurfaceMesh hollow = boundary_of(
        structured_box<3>({100.25, 0.5, 1.0}, {100.75, 1.5, 2.0}, {2, 3, 3}, CellShape::tetrahedron));  // 0.5 m^3, 4 m^2
    for (std::size_t i = 0; i < hollow.faces.values.size(); i += 3)
        std::swap(hollow.faces.values[i], hollow.faces.values[i + 1]);
    const std::vector<SurfaceMesh> both{box_of_triangles(), hollow};
    for (const bool keeps : {false, true}) {
        CAPTURE(keeps);
        const Mesh<3> mesh = fill(combine(both), {.size = 0.25, .name = "shell", .keeps_triangles = keeps});
        CHECK(volume_of(mesh) == Approx(5.5).epsilon(1e-9));
        double area = 0.0;
        for (const std::int32_t face : mesh.group("boundary").faces)
            area += mesh.face_measure[static_cast<std::size_t>(face)];
        CHECK(area == Approx(26.0).epsilon(1e-9));
        test::check_closed_cells(mesh);
    }
}

TEST_CASE("what is not one closed surface is refused", "[mesh][fill]") {
    SurfaceMesh open = box_of_triangles();
    open.faces.values.resize(open.faces.values.size() - 3);
    open.faces.offsets.pop_back();
    CHECK_THROWS_AS(fill(open, {}), MeshError);
    SurfaceMesh flipped = box_of_triangles();
    std::swap(flipped.faces.values[0], flipped.faces.values[1]);
    CHECK_THROWS_AS(fill(flipped, {}), MeshError);
    const std::vector<SurfaceMesh> two{
        box_of_triangles(), boundary_of(structured_box<3>({0, 0, 0}, {1, 1, 1}, {1, 1, 1}, CellShape::tetrahedron))};
    CHECK_THROWS_WITH(fill(combine(two), {}), Catch::Contains("it has 2 outer surfaces"));
    CHECK_THROWS_AS(fill(box_of_triangles(), {.size = 0.0}), MeshError);
}

TEST_CASE("a surface of quadrangles, or of faces with vertices of their own, is filled as one of triangles",
          "[mesh][fill]") {
    const SurfaceMesh bricks = boundary_of(structured_box<3>({0, 0, 0}, {1, 2, 3}, {2, 2, 2}, CellShape::hexahedron));
    SurfaceMesh apart = bricks;
    apart.vertices.clear();
    for (std::int32_t& v : apart.faces.values) {
        apart.vertices.push_back(bricks.vertices[static_cast<std::size_t>(v)]);
        v = static_cast<std::int32_t>(apart.vertices.size()) - 1;
    }
    for (const bool keeps : {false, true}) {
        const Mesh<3> mesh = fill(bricks, {.size = 0.5, .keeps_triangles = keeps});
        CHECK(volume_of(mesh) == Approx(6.0).epsilon(1e-12));
        if (keeps) CHECK(std::ssize(mesh.boundary_faces) == 2 * bricks.faces.size());
        test::check_closed_cells(mesh);
        CHECK(fill(apart, {.size = 0.5, .keeps_triangles = keeps}).n_cells() == mesh.n_cells());
    }
}
