#include <catch2/catch.hpp>

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>

#include "abut/geometry/health/surface_health.hpp"
#include "abut/geometry/triangulate.hpp"
#include "geometry/soups.hpp"

using namespace abut;
using namespace abut::geometry;
using namespace abut::test;
using Catch::Matchers::Contains;

namespace {

std::int64_t n_intersections(const Faces& faces) {
    return checked(faces, {.self_intersections = true}).n_self_intersections;
}

/// Every face with corners of its own.
Faces unwelded(const Faces& faces) {
    Faces result;
    for (std::int32_t face = 0; face < faces.size(); ++face) {
        std::vector<std::int32_t> loop;
        for (const std::int32_t v : faces.soup().vertices_of(face)) {
            loop.push_back(static_cast<std::int32_t>(result.vertices.size()));
            result.vertices.push_back(faces.vertices[static_cast<std::size_t>(v)]);
        }
        result.add(loop);
    }
    return result;
}

}  // namespace

TEST_CASE("no faces are checked without complaint, and are not sound", "[geometry][health]") {
    const SurfaceReport health = check_surface({}, {.self_intersections = true});
    CHECK(health.n_faces == 0);
    CHECK(health.n_usable() == 0);
    CHECK(health.components.empty());
    CHECK(health.box.empty());
    CHECK_FALSE(health.closed());
    CHECK_FALSE(health.sound());
    CHECK(checked(faces({{0, 0, 0}, {1, 0, 0}}, {})).unreferenced_vertices == std::vector<std::int32_t>{0, 1});
}

TEST_CASE("one triangle is one open component with one rim of three edges", "[geometry][health]") {
    const SurfaceReport health = checked(one_face({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}));
    CHECK(health.n_usable() == 1);
    CHECK(health.n_edges == 3);
    CHECK(health.boundary_edges.size() == 3);
    CHECK(health.n_holes == 1);
    REQUIRE(health.components.size() == 1);
    CHECK_FALSE(health.components[0].closed);
    CHECK(health.area == Approx(6.0));
    CHECK(health.shortest_edge == 3.0);
    CHECK(health.longest_edge == 5.0);
    CHECK(health.worst_aspect == Approx(5.0 / 2.4));  // the height on the side of 5 is 3 4 / 5
    CHECK_FALSE(health.sound());
}

TEST_CASE("offsets that do not fit are the host's mistake and throw", "[geometry][health]") {
    Faces bad = one_face(corner_triangle());
    bad.offsets = {0, 2};
    CHECK_THROWS_WITH(check_surface(bad.soup()), Contains("`face_offsets` ends with 2 for 3 entries"));
    bad.offsets = {1, 3};
    CHECK_THROWS_AS(check_surface(bad.soup()), BadInput);
    bad.offsets = {0, 5, 3};
    CHECK_THROWS_WITH(face_faults(bad.soup()), Contains("`face_offsets` falls after face 1"));
}

TEST_CASE("vertices that no face names, and such at one position, are counted", "[geometry][health]") {
    Faces soup = one_face(corner_triangle());
    soup.vertices.push_back({7, 7, 7});
    soup.vertices.push_back({1, 0, 0});
    soup.vertices.push_back({-0.0, 0, 0});
    const SurfaceReport health = checked(soup);
    CHECK(health.unreferenced_vertices == std::vector<std::int32_t>{3, 4, 5});
    CHECK(health.n_unwelded_vertices == 2);
    CHECK(health.merged_vertices == std::vector<std::int32_t>{0, 1, 2, 3, 1, 0});
}

TEST_CASE("a cube is sound, welded or not", "[geometry][health]") {
    const bool weld = GENERATE(true, false);
    const SurfaceReport health = checked(weld ? cube() : unwelded(cube()), {.self_intersections = true});
    CHECK(health.sound());
    CHECK(health.n_edges == 12);
    CHECK(health.n_unwelded_vertices == (weld ? 0 : 24 - 8));
    CHECK(health.components[0].volume == Approx(1.0));
    CHECK(health.area == Approx(6.0));
}

TEST_CASE("a closed surface that is turned inside out has a negative volume", "[geometry][health]") {
    Faces box = cube();
    for (std::int32_t face = 0; face < box.size(); ++face)
        std::reverse(box.corners.begin() + box.offsets[static_cast<std::size_t>(face)],
                     box.corners.begin() + box.offsets[static_cast<std::size_t>(face) + 1]);
    const SurfaceReport health = checked(box);
    CHECK(health.closed());
    CHECK(health.components[0].inside_out);
    CHECK(health.components[0].volume == Approx(-1.0));
    CHECK_FALSE(health.sound());
}

TEST_CASE("one face turned round shows on each of its edges", "[geometry][health]") {
    Faces box = cube();
    std::reverse(box.corners.begin(), box.corners.begin() + 4);
    const SurfaceReport health = checked(box);
    CHECK(health.inconsistent_edges.size() == 4);
    CHECK(health.closed());
    CHECK_FALSE(health.components[0].oriented);
    CHECK_FALSE(health.sound());
}

TEST_CASE("a Moebius strip cannot be oriented", "[geometry][health]") {
    const SurfaceReport health = checked(moebius_strip(12));
    CHECK(health.n_usable() == 24);
    CHECK(health.inconsistent_edges.size() == 1);
    CHECK(health.n_holes == 1);
    CHECK(health.components.size() == 1);
    CHECK_FALSE(health.components[0].oriented);
}

TEST_CASE("an edge of three faces is not manifold", "[geometry][health]") {
    const SurfaceReport health =
        checked(faces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}));
    REQUIRE(health.non_manifold_edges.size() == 1);
    CHECK(health.non_manifold_edges[0].n_faces == 3);
    CHECK(health.non_manifold_edges[0].first == 0);
    CHECK(health.non_manifold_edges[0].second == 1);
    CHECK(health.components.size() == 1);
    CHECK(health.boundary_edges.size() == 6);
    CHECK_FALSE(health.closed());
}

TEST_CASE("two cubes along one edge enclose two volumes, along no edge they are two components", "[geometry][health]") {
    Faces touching = cube();
    append(touching, cube(), {1, 1, 0});  // an edge
    SurfaceReport health = checked(touching);
    CHECK(health.components.size() == 1);
    CHECK(health.non_manifold_edges.size() == 1);
    CHECK(health.closed());
    CHECK(health.components[0].volume == Approx(2.0));
    Faces apart = cube();
    append(apart, cube(), {1, 1, 1});  // a corner
    health = checked(apart);
    REQUIRE(health.components.size() == 2);
    CHECK(health.components[1].first_face == 6);
    CHECK(health.components[1].volume == Approx(1.0));
    CHECK(std::count(health.face_component.begin(), health.face_component.end(), 1) == 6);
    CHECK(health.sound());
}

TEST_CASE("a sphere with k faces removed has k holes", "[geometry][health]") {
    const int k = GENERATE(0, 1, 5);
    const Faces whole = sphere(3);
    Faces pierced;
    pierced.vertices = whole.vertices;
    for (std::int32_t face = 0; face < whole.size(); ++face) {
        const auto loop = whole.soup().vertices_of(face);
        if (face % 64 != 3 || face / 64 >= k) pierced.add({loop.begin(), loop.end()});  // 64 faces to an octant
    }
    const SurfaceReport health = checked(pierced);
    CHECK(health.n_faces == 512 - k);
    CHECK(health.n_holes == k);
    CHECK(health.boundary_edges.size() == static_cast<std::size_t>(3 * k));
    CHECK(health.closed() == (k == 0));
    CHECK(static_cast<int>(health.n_vertices) - health.n_edges + health.n_faces == 2 - k);  // Euler
}

TEST_CASE("the volume inside a sphere of triangles approaches 4/3 pi as the square of their size", "[geometry][health]") {
    const double exact = 4.0 / 3.0 * std::numbers::pi;
    const double coarse = exact - checked(sphere(3)).components[0].volume;
    const double fine = exact - checked(sphere(4)).components[0].volume;
    CHECK(coarse > 0.0);
    CHECK(coarse / fine == Approx(4.0).epsilon(0.02));
}

TEST_CASE("two triangles that cross are found", "[geometry][health][intersections]") {
    const Faces crossing = two_triangles({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0}});
    const SurfaceReport health = checked(crossing, {.self_intersections = true});
    CHECK(health.n_self_intersections == 1);
    CHECK(health.self_intersections == std::vector<IndexPair>{{0, 1}});
    CHECK_FALSE(checked(crossing).looked_for_self_intersections);
    CHECK(n_intersections(two_triangles({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, -1}, {2, 2, 1}, {3, 3, 0}})) == 0);
}

TEST_CASE("a corner that lies on another face touches it", "[geometry][health][intersections]") {
    const double height = GENERATE(0.0, 1e-300);
    const Faces touching =
        two_triangles({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0.5, 0.5, height}, {0.5, 0.6, 1}, {0.6, 0.5, 1}});
    CHECK(n_intersections(touching) == (height > 0.0 ? 0 : 1));
}

TEST_CASE("faces that share a corner intersect where they meet beyond it", "[geometry][health][intersections]") {
    const auto fan = [](const Vector<3>& a, const Vector<3>& b) {
        return n_intersections(faces({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, a, b}, {{0, 1, 2}, {0, 3, 4}}));
    };
    CHECK(fan({-1, 0, 0}, {0, -1, 0}) == 0);     // in one plane, beside each other
    CHECK(fan({1, 1, -1}, {1, 1, 1}) == 1);      // through the inside
    CHECK(fan({1, 0.5, 0}, {-1, 0, 1}) == 1);    // an edge of one in the plane of the other
    CHECK(fan({0.1, 0.1, -1}, {5, 5, 6}) == 1);  // leaves through the opposite edge
    CHECK(fan({-1, -1, -1}, {-1, -1, 1}) == 0);
}

TEST_CASE("faces that share an edge intersect if folded onto each other", "[geometry][health][intersections]") {
    const auto hinge = [](const Vector<3>& a) {
        return n_intersections(faces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, a}, {{0, 1, 2}, {1, 0, 3}}));
    };
    CHECK(hinge({0, -1, 0}) == 0);
    CHECK(hinge({0.5, 0.5, 1e-300}) == 0);  // all but folded
    CHECK(hinge({0.5, 0.25, 0}) == 1);
    CHECK(hinge({0.3, 2, 0}) == 1);
}

TEST_CASE("a sphere and a torus do not pass through themselves, a torus without a hole does",
          "[geometry][health][intersections]") {
    CHECK(n_intersections(sphere(4)) == 0);
    CHECK(n_intersections(torus(24, 0.9)) == 0);
    CHECK(n_intersections(cube()) == 0);
    CHECK(n_intersections(torus(24, 2.5)) > 0);
}

TEST_CASE("two spheres intersect in the faces that a test of every pair finds", "[geometry][health][intersections]") {
    Faces both = sphere(2);
    append(both, sphere(2), {0.9, 0.3, 0.2});
    const SurfaceReport health = checked(both, {.self_intersections = true, .max_listed_pairs = 3});
    CHECK(health.self_intersections.size() == 3);
    const auto merged = health.merged_vertices;
    // Pair by pair: a soup of two faces has no candidates to miss.
    std::int64_t n = 0;
    for (std::int32_t i = 0; i < 128; ++i)
        for (std::int32_t j = 128; j < 256; ++j) {
            const auto a = both.soup().vertices_of(i), b = both.soup().vertices_of(j);
            n += n_intersections(faces(both.vertices, {{a.begin(), a.end()}, {b.begin(), b.end()}}));
        }
    CHECK(n > 20);
    CHECK(health.n_self_intersections == n);
}

TEST_CASE("what intersects does not depend on the number of threads", "[geometry][health][intersections]") {
    const Faces knot = torus(32, 2.5);
    const auto found = [&](std::size_t n_threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, n_threads);
        return checked(knot, {.self_intersections = true}).self_intersections;
    };
    CHECK(found(1) == found(4));
}

TEST_CASE("polygons are cut into triangles of the same area and sense, none of them flat", "[geometry][triangulate]") {
    const auto area_sum = [](const std::vector<Vector<3>>& corners) {
        Vector<3> sum = Vector<3>::Zero();
        double smallest = infinite;
        const auto cut = cut_into_triangles(corners);
        CHECK(cut.size() == corners.size() - 2);
        for (const auto& t : cut) {
            const Vector<3>&a = corners[static_cast<std::size_t>(t[0])], &b = corners[static_cast<std::size_t>(t[1])],
                  &c = corners[static_cast<std::size_t>(t[2])];
            sum += 0.5 * (b - a).cross(c - a);
            smallest = std::min(smallest, 0.5 * (b - a).cross(c - a).z());
        }
        CHECK(smallest > 0.0);
        return sum.z();
    };
    const int n = GENERATE(3, 4, 7, 16);
    CHECK(area_sum(regular_polygon(n)) == Approx(0.5 * n * std::sin(2.0 * std::numbers::pi / n)));
    // Two straight corners on every side of a square: 12 corners, area 9.
    std::vector<Vector<3>> square;
    const std::vector<Vector<3>> turns = {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}};
    for (std::size_t i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k) square.push_back(turns[i] + k / 3.0 * (turns[(i + 1) % 4] - turns[i]));
    CHECK(area_sum(square) == Approx(9.0));
    // A straight corner leaves one way to cut a quadrangle.
    CHECK(area_sum({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}) == Approx(2.0));
}

namespace {

std::string described(const Faces& faces, const HealthOptions& options = {}, std::span<const std::int64_t> labels = {}) {
    std::string text;
    for (const std::string& line : describe(faces.soup(), checked(faces, options), labels)) text += line + "\n";
    return text;
}

}  // namespace

TEST_CASE("the health of a sound cube in words: counts, box, volume, nothing wrong", "[geometry][health]") {
    const std::string text = described(cube(), {.self_intersections = true});
    for (const char* words :
         {"6 faces, 8 vertices, 1 component", "from (0, 0, 0) to (1, 1, 1) m, area 6 m^2", "edges of 1 to 1 m",
          "closed, volume 1 m^3", "every face can be used", "0 slivers", "no self-intersection"})
        CHECK_THAT(text, Contains(words));
    for (const char* words : {"cannot", "open", "inside out", "repeat", "not "}) CHECK_THAT(text, !Contains(words));
}

TEST_CASE("the health of a bad surface in words: what is wrong, how often, and which face first, by its label",
          "[geometry][health]") {
    Faces bad = cube();
    bad.vertices.push_back({no_number, 0, 0});
    bad.vertices.push_back({5, 5, 5});
    bad.add({0, 1, 8});   // not finite
    bad.add({0, 1, 77});  // no such vertex
    bad.add({1, 2, 6, 5});
    bad.add({5, 6, 2, 1});
    bad.vertices.push_back({0, 0, 0});
    const std::vector<std::int64_t> labels{10, 11, 12, 13, 14, 15, 16, 17, 18, 19};
    const std::string text = described(bad, {}, labels);
    for (const char* words : {"10 faces", "3 faces cannot be used: 1 index_out_of_range, 1 not_finite, 1 duplicate",
                              "face 16 has vertex 8", "face 17 names vertex 77", "face 18 repeats an earlier face",
                              "2 vertices that no face names", "1 vertex at the place of an earlier one",
                              "1 vertex with a coordinate that is not finite", "4 edges of three faces or more",
                              "1 face repeats an earlier one the other way round: first face 19 that of face 13"})
        CHECK_THAT(text, Contains(words));
    CHECK_THAT(described(one_face(corner_triangle())), Contains("open: 1 hole or rim of 3 edges, the first edge at face 0"));
    CHECK_THAT(described(Faces{}), Contains("0 faces, 0 vertices, 0 components"));
}

TEST_CASE("a report of another surface is not put into words", "[geometry][health]") {
    const Faces one = one_face(corner_triangle());
    CHECK_THROWS_WITH(describe(one.soup(), checked(cube())), Contains("a report of 6 faces") && Contains("for 1 faces"));
    CHECK_THROWS_AS(describe(one.soup(), checked(one), std::vector<std::int64_t>{1, 2}), BadInput);
}
