#include <algorithm>
#include <array>

#include "abut/mesh/shapes/surface_shapes.hpp"
#include "mesh/meshes.hpp"
#include "mesh/surfaces.hpp"

using namespace abut;
using namespace abut::mesh;
using namespace abut::mesh::test;
using Catch::Matchers::Contains;

TEST_CASE("connected parts become bodies, welded or not", "[mesh][surface]") {
    std::vector<SurfaceMesh> tori = {torus_surface({.axis = 2}), torus_surface({.centre = {1, 0, 0}, .axis = 1})};
    SurfaceMesh both = combine(tori);
    CHECK(both.body_names == std::vector<std::string>{"torus.torus", "torus.torus_2"});
    CHECK(geometry::check_surface(both.soup(), {.self_intersections = true}).sound());  // interlocked, apart
    name_connected_bodies(both);
    CHECK(both.body_names == std::vector<std::string>{"body_1", "body_2"});
    CHECK(std::count(both.face_body.begin(), both.face_body.end(), 1) == tori[1].faces.size());

    const ScratchFolder folder;
    save(folder / "tori.stl", binary_stl(both));
    const SurfaceMesh apart = read_surface(folder / "tori.stl", {.weld = false, .connected_bodies = true});
    CHECK(apart.body_names.size() == 2);
    CHECK(apart.face_body == both.face_body);
}

TEST_CASE("welding keeps vertices apart that move apart", "[mesh][surface]") {
    SurfaceMesh mesh;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    mesh.faces.append(std::array{0, 1, 2});
    mesh.faces.append(std::array{3, 5, 4});
    mesh.faces.append(std::array{3, 5, 77});
    mesh.face_body = {0, 0, 0};
    mesh.body_names = {"a"};
    SurfaceMesh moving = mesh;
    CHECK(weld(mesh) == 2);
    CHECK(mesh.vertices.size() == 4);
    CHECK(mesh.faces.values == std::vector<std::int32_t>{0, 1, 2, 1, 3, 2, 1, 3, -1});
    moving.displacement.assign(6, Vector<3>::Zero());
    moving.displacement[4] = {0, 0, 1};
    CHECK(weld(moving) == 1);
    CHECK(moving.faces.values == std::vector<std::int32_t>{0, 1, 2, 1, 4, 3, 1, 4, -1});
    CHECK(moving.displacement[3] == Vector<3>(0, 0, 1));
}

TEST_CASE("cleaning under `fail` names the first faces, their faults and the remedy", "[mesh][surface]") {
    SurfaceMesh mesh = torus_surface({});
    CHECK(clean(mesh, health_of(mesh), UnusableFaces::fail).mesh.faces.values == mesh.faces.values);
    for (int i = 0; i < 6; ++i) {
        mesh.faces.append(std::array{0, 1, 9999});
        mesh.face_body.push_back(0);
    }
    const auto health = health_of(mesh);
    CHECK_THROWS_WITH(clean(mesh, health, UnusableFaces::fail),
                      Contains("torus: 6 of 1542 faces cannot be used: face 1536 names vertex 9999, but there are 768; face "
                               "1537 names") &&
                          Contains("; and 1 more. Mend the surface, or have such faces left out: UnusableFaces::skip."));
    SurfaceMesh concave;  // an L of one face
    concave.name = "L";
    concave.vertices = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    concave.faces.append(std::array{0, 1, 2, 3, 4, 5});
    concave.face_body = {0};
    CHECK_THROWS_WITH(clean(concave, health_of(concave), UnusableFaces::fail),
                      Contains("face 0 is not convex") && Contains("cut faces that are not convex into triangles"));
    const CleanSurface rest = clean(mesh, health, UnusableFaces::skip);
    CHECK(rest.n_skipped_faces == 6);
    CHECK(health_of(rest.mesh).sound());
    CHECK_THROWS_AS(clean(torus_surface({.n_tube = 8}), health, UnusableFaces::skip), BadInput);
}

TEST_CASE("cleaning cuts what is not flat and says where each face came from", "[mesh][surface]") {
    SurfaceMesh mesh;
    mesh.name = "bent";
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.1}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}, {1, 0, 0}};
    mesh.faces.append(std::array{0, 0, 0});     // no face
    mesh.faces.append(std::array{0, 1, 2, 3});  // not flat
    mesh.faces.append(std::array{1, 4, 5});     // fine
    mesh.faces.append(std::array{1, 6, 5, 2});  // a corner twice
    mesh.face_body = {0, 1, 2, 1};
    mesh.body_names = {"a", "b", "c"};
    mesh.face_label = {10, 11, 12, 13};
    const CleanSurface result = clean(mesh, health_of(mesh), UnusableFaces::skip);
    CHECK(result.n_skipped_faces == 1);
    CHECK(result.n_cut_faces == 1);
    CHECK(result.n_flat_pieces == 0);
    CHECK(result.input_face == std::vector<std::int32_t>{1, 1, 2, 3});
    CHECK(result.mesh.face_body == std::vector<std::int32_t>{1, 1, 2, 1});
    CHECK(result.mesh.face_label == std::vector<std::int64_t>{11, 11, 12, 13});
    CHECK(result.mesh.faces[3].size() == 3);
    const auto health = health_of(result.mesh);
    CHECK(health.n_usable() == 4);
    CHECK(health.non_planar_faces.empty());
    CHECK(health.repeated_corner_faces.empty());
    mesh.faces = {};
    mesh.faces.append(std::array{0, 0, 0});
    CHECK_THROWS_WITH(clean(mesh, health_of(mesh), UnusableFaces::skip), Contains("bent: 1 of 1 face cannot be used"));
}
