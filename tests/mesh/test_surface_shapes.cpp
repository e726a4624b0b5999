#include "mesh/meshes.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "abut/geometry/polygon.hpp"
#include "abut/mesh/shapes/surface_shapes.hpp"

using namespace abut;
using namespace abut::mesh;
using Catch::Matchers::Contains;

namespace {

geometry::SurfaceReport checked(const SurfaceMesh& mesh) {
    return geometry::check_surface(mesh.soup(), {.self_intersections = true});
}
double volume_of(const SurfaceMesh& mesh) {
    const auto health = geometry::check_surface(mesh.soup());
    REQUIRE(health.components.size() == 1);
    return health.components[0].volume;
}
/// V - E + F = 2 - 2 genus.
std::int32_t euler(const geometry::SurfaceReport& health) { return health.n_vertices - health.n_edges + health.n_faces; }

/// One component, sound, every vertex used once.
void check_closed(const SurfaceMesh& mesh, int genus) {
    const auto health = checked(mesh);
    CHECK(health.sound());
    CHECK(health.components.size() == 1);
    CHECK(health.unreferenced_vertices.empty());
    CHECK(health.n_unwelded_vertices == 0);
    CHECK(euler(health) == 2 - 2 * genus);
    CHECK(mesh.body_names == std::vector<std::string>{mesh.name});
    CHECK(mesh.face_body.size() == static_cast<std::size_t>(mesh.faces.size()));
}

}  // namespace

TEST_CASE("a torus is closed, of genus 1, and its volume tends to 2 pi^2 R r^2", "[mesh][surface][shapes]") {
    const int axis = GENERATE(0, 1, 2);
    const auto torus = [axis](int n) {
        return torus_surface(
            {.centre = {3, 1, 2}, .radius = 1.5, .tube_radius = 0.4, .n_around = 2 * n, .n_tube = n, .axis = axis});
    };
    check_closed(torus(12), 1);
    CHECK(torus(12).faces.size() == 2 * 24 * 12);
    const double exact = 2.0 * std::numbers::pi * std::numbers::pi * 1.5 * 0.4 * 0.4;
    const double coarse = exact - volume_of(torus(16)), fine = exact - volume_of(torus(32));
    CHECK(coarse > 0.0);
    CHECK(coarse / fine == Approx(4.0).epsilon(0.02));
    // The axis is the short way.
    const auto box = geometry::check_surface(torus(16).soup()).box;
    for (int i = 0; i < 3; ++i) CHECK(box.upper[i] - box.lower[i] == Approx(i == axis ? 0.8 : 3.8).epsilon(1e-12));
}

TEST_CASE("a gear is closed, of genus 1, and holds what outline and bore enclose", "[mesh][surface][shapes]") {
    const GearOptions options{.n_teeth = 12, .n_flank = GENERATE(1, 3), .turn = 0.1, .axis = GENERATE(0, 2)};
    const SurfaceMesh gear = gear_surface(options);
    check_closed(gear, 1);
    CHECK(gear.faces.size() == 16 * 12 * options.n_flank * (3 + 4));
    if (options.n_flank > 1) return;
    // Triangles from the axis to each line of the outline, less the same of the bore: r1 r2 sin(angle) / 2.
    const double pitch = 2.0 * std::numbers::pi / 12, tip = 0.3 * pitch, flank = 0.15 * pitch, root = 0.4 * pitch;
    const double outline = 12 * 0.5 * (std::sin(tip) + 2 * 0.8 * std::sin(flank) + 0.8 * 0.8 * std::sin(root));
    const double bore = 12 * 0.5 * 0.3 * 0.3 * (std::sin(tip) + 2 * std::sin(flank) + std::sin(root));
    CHECK(volume_of(gear) == Approx(0.2 * (outline - bore)));
}

TEST_CASE("a barrel is closed, of genus 0, and holds its polygon times its length", "[mesh][surface][shapes]") {
    const int n = GENERATE(1, 2, 5, 8), axis = GENERATE(0, 2);
    const BarrelOptions options{.centre = {1, 0, 5}, .radius = 0.7, .length = 3.0, .n_side = n, .n_along = 6, .axis = axis};
    const SurfaceMesh barrel = barrel_surface(options);
    check_closed(barrel, 0);
    CHECK(barrel.faces.size() == 8 * n * 6 + 4 * n * n);
    CHECK(volume_of(barrel) == Approx(3.0 * 0.5 * 4 * n * 0.7 * 0.7 * std::sin(2.0 * std::numbers::pi / (4 * n))));
    CHECK(checked(barrel).worst_aspect < 10.0);  // no fan, no cut-off corner
}

TEST_CASE("a barrel without caps has two rims", "[mesh][surface][shapes]") {
    const auto health = checked(barrel_surface({.n_side = 4, .closed = false}));
    CHECK(health.n_holes == 2);
    CHECK(health.boundary_edges.size() == 2 * 16);
    CHECK(health.inconsistent_edges.empty());
    CHECK(euler(health) == 0);
}

TEST_CASE("a sphere is closed, of genus 0, and its volume tends to 4/3 pi r^3", "[mesh][surface][shapes]") {
    check_closed(sphere_surface({.n_subdivisions = 3}), 0);
    CHECK(sphere_surface({.n_subdivisions = 3}).faces.size() == 20 * 64);
    const double exact = 4.0 / 3.0 * std::numbers::pi * 8.0;
    const auto lacking = [&](int n) { return exact - volume_of(sphere_surface({.radius = 2.0, .n_subdivisions = n})); };
    CHECK(lacking(3) > 0.0);
    CHECK(lacking(3) / lacking(4) == Approx(4.0).epsilon(0.02));
    CHECK(checked(sphere_surface({.n_subdivisions = 4})).worst_aspect < 2.0);
    // The icosahedron of circumradius 1: edge a, volume 5 (3 + sqrt 5) a^3 / 12.
    const double a = 1.0 / std::sin(2.0 * std::numbers::pi / 5);
    CHECK(volume_of(sphere_surface({.n_subdivisions = 0})) == Approx(5.0 * (3.0 + std::sqrt(5.0)) * a * a * a / 12.0));
}

TEST_CASE("a sheet is one open piece that faces z and follows its waves", "[mesh][surface][shapes]") {
    const SurfaceMesh sheet = sheet_surface({.size_x = 2.0, .n_x = 20, .n_y = 12, .amplitude = 0.1});
    const auto health = checked(sheet);
    CHECK(health.n_self_intersections == 0);
    CHECK(health.n_holes == 1);
    CHECK(health.boundary_edges.size() == 2 * (20 + 12));
    CHECK(euler(health) == 1);
    CHECK(health.inconsistent_edges.empty());
    for (const Vector<3>& x : sheet.vertices)
        CHECK(
            x.z() ==
            Approx(0.1 * std::sin(3.0 * std::numbers::pi * x.x()) * std::cos(6.0 * std::numbers::pi * x.y())).margin(1e-14));
    const auto flat = sheet_surface({.amplitude = 0.0});
    CHECK(geometry::check_surface(flat.soup()).area == Approx(1.0));
    std::vector<Vector<3>> corners;
    for (const std::int32_t v : flat.faces[0]) corners.push_back(flat.vertices[static_cast<std::size_t>(v)]);
    CHECK(geometry::face_normal<3>(corners).z() == Approx(1.0));
}

TEST_CASE("random triangles are those of their seed and fill their box evenly", "[mesh][surface][shapes]") {
    const auto soup = random_triangles({.n = 5000, .seed = 7, .lower = {1, 1, 1}, .box_size = 2.0, .size = 0.1});
    CHECK(test::same_bits(
        soup.vertices, random_triangles({.n = 5000, .seed = 7, .lower = {1, 1, 1}, .box_size = 2.0, .size = 0.1}).vertices));
    CHECK_FALSE(test::same_bits(
        soup.vertices, random_triangles({.n = 5000, .seed = 8, .lower = {1, 1, 1}, .box_size = 2.0, .size = 0.1}).vertices));
    Vector<3> mean = Vector<3>::Zero();
    for (const Vector<3>& x : soup.vertices) mean += x / static_cast<double>(soup.vertices.size());
    // Of an even distribution over 2: variance 4/12, over 5000 centres; five standard deviations.
    for (int i = 0; i < 3; ++i) CHECK(mean[i] == Approx(2.0).margin(5.0 * std::sqrt(4.0 / 12.0 / 5000)));
    const auto health = geometry::check_surface(soup.soup());
    CHECK(health.n_usable() == 5000);
    CHECK(health.components.size() == 5000);
    // The first two numbers of the seed 1234567, as they are known for this generator: 6457827717110365317 and
    // 3203168211198807973.
    const auto known = random_triangles({.n = 1, .seed = 1234567, .size = 1e-300});
    CHECK(known.vertices[0].x() == static_cast<double>(6457827717110365317U >> 11) * 0x1p-53);
    CHECK(known.vertices[0].y() == static_cast<double>(3203168211198807973U >> 11) * 0x1p-53);
}

TEST_CASE("arguments that make no shape are refused by name, value and limit", "[mesh][surface][shapes]") {
    const double no_number = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(torus_surface({.radius = -1.0}),
                      Contains("torus: radius is -1 m, a finite length above 0 is needed."));
    CHECK_THROWS_WITH(torus_surface({.radius = 1.0, .tube_radius = 1.0}),
                      Contains("tube_radius is 1 m, less than radius, 1 m, is needed."));
    CHECK_THROWS_WITH(torus_surface({.n_tube = 2}), Contains("n_tube is 2, at least 3 is needed."));
    CHECK_THROWS_WITH(torus_surface({.axis = 3}), Contains("axis is 3, 0, 1 or 2 is needed."));
    CHECK_THROWS_WITH(torus_surface({.n_around = 100000, .n_tube = 100000}),
                      Contains("torus: has 2e+10 triangles, at most 200000000 are allowed. Lower the counts."));
    CHECK_THROWS_WITH(gear_surface({.root_radius = 1.2}), Contains("root_radius is 1.2 m, less than tip_radius, 1 m,"));
    CHECK_THROWS_WITH(gear_surface({.tooth_share = 0.5}), Contains("tooth_share is 0.5, more than 0 and less than 0.5"));
    CHECK_THROWS_AS(gear_surface({.turn = no_number}), MeshError);
    CHECK_THROWS_AS(sheet_surface({.amplitude = no_number}), MeshError);
    CHECK_THROWS_AS(sheet_surface({.n_x = 0}), MeshError);
    CHECK_THROWS_AS(barrel_surface({.centre = {0, no_number, 0}}), MeshError);
    CHECK_THROWS_AS(sphere_surface({.n_subdivisions = 12}), MeshError);
    CHECK_THROWS_AS(random_triangles({.n = 0}), MeshError);
}
