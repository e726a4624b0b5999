#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

#include "abut/geometry/health/surface_health.hpp"
#include "abut/geometry/overlap/overlap.hpp"
#include "geometry/soups.hpp"

using namespace abut;
using namespace abut::geometry;
using namespace abut::test;
using Catch::Matchers::Contains;

namespace {

FaceFault fault_of(const Faces& faces, std::int32_t face = 0) {
    return face_faults(faces.soup())[static_cast<std::size_t>(face)];
}
FaceFault fault_of_corners(const std::vector<Vector<3>>& corners) { return fault_of(one_face(corners)); }

}  // namespace

TEST_CASE("an index out of range is the first fault of a face", "[geometry][health]") {
    const Faces bad = faces(corner_triangle(), {{0, 1, 3}, {-1, 0, 1}, {0, 9}, {0, 1, 2}});
    const std::vector<FaceFault> faults = face_faults(bad.soup());
    for (std::size_t face = 0; face < 3; ++face) CHECK(faults[face] == FaceFault::index_out_of_range);
    CHECK(faults[3] == FaceFault::none);
    CHECK(describe(bad.soup(), 0, faults[0]) == "names vertex 3, but there are 3");
    CHECK(describe(bad.soup(), 1, faults[1]) == "names vertex -1, but there are 3");
    CHECK(checked(bad, {.self_intersections = true}).n_usable() == 1);
}

TEST_CASE("a face has 3 to max_polygon_vertices corners", "[geometry][health]") {
    CHECK(fault_of(faces(corner_triangle(), {{}})) == FaceFault::too_few_corners);
    CHECK(fault_of(faces(corner_triangle(), {{0, 1}})) == FaceFault::too_few_corners);
    CHECK(fault_of_corners(regular_polygon(max_polygon_vertices)) == FaceFault::none);
    CHECK(fault_of_corners(regular_polygon(max_polygon_vertices + 1)) == FaceFault::too_many_corners);
}

TEST_CASE("a corner that is NaN or infinite makes its faces unusable and no others", "[geometry][health]") {
    const double bad = GENERATE(as<double>{}, no_number, infinite, -infinite);
    CAPTURE(bad);
    const Faces soup = faces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {bad, 1, 1}}, {{0, 1, 2}, {0, 1, 3}, {3, 3, 3}});
    const SurfaceReport health = checked(soup, {.self_intersections = true});
    CHECK(health.unusable_faces == std::vector<std::int32_t>{1, 2});
    CHECK(health.n_faults[static_cast<std::size_t>(FaceFault::not_finite)] == 2);
    CHECK(health.n_bad_vertices == 1);
    CHECK(health.box.upper == Vector<3>(1, 1, 0));
    CHECK(std::isfinite(health.area));
    CHECK_THAT(describe(soup.soup(), 1, health.faults[1]), Contains("has vertex 3 at (") && Contains("finite"));
}

TEST_CASE("coordinates and sizes beyond what products of doubles bear are refused", "[geometry][health]") {
    CHECK(fault_of_corners(corner_triangle(1e19)) == FaceFault::none);
    CHECK(fault_of_corners(corner_triangle(1e75)) == FaceFault::none);
    CHECK(fault_of_corners(corner_triangle(1.1e75)) == FaceFault::too_large);
    CHECK(fault_of_corners(corner_triangle(1e300)) == FaceFault::too_large);
    CHECK(fault_of_corners(corner_triangle(1e-74)) == FaceFault::none);
    CHECK(fault_of_corners(corner_triangle(1e-76)) == FaceFault::too_small);
    CHECK(fault_of_corners(corner_triangle(1e-200)) == FaceFault::too_small);
    CHECK(fault_of_corners({{0, 0, 0}, {1, 0, 0}, {0.5, 1e-80, 0}}) == FaceFault::too_small);
    const Faces huge = one_face(corner_triangle(1e76));
    CHECK(describe(huge.soup(), 0, FaceFault::too_large) ==
          "has vertex 1 at (1e+76, 0, 0) m, coordinates up to 1e+75 m are allowed");
}

TEST_CASE("a surface of any allowed size gives measures of that size", "[geometry][health]") {
    const double size = GENERATE(1e-70, 1e-20, 1.0, 1e19, 1e70);
    Faces box = cube();
    for (Vector<3>& x : box.vertices) x *= size;
    const SurfaceReport health = checked(box, {.self_intersections = true});
    CHECK(health.sound());
    CHECK(health.area == Approx(6.0 * size * size).margin(0.0));
    CHECK(health.components[0].volume == Approx(size * size * size).margin(0.0));
    CHECK(health.worst_aspect == Approx(1.0));
}

TEST_CASE("corners at fewer than three places make no face", "[geometry][health]") {
    CHECK(fault_of_corners({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}) == FaceFault::repeated_corner);
    CHECK(fault_of_corners({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}) == FaceFault::repeated_corner);
    CHECK(fault_of_corners({{0, 0, 0}, {1, 0, 0}, {-0.0, 0, 0}, {1, 0, 0}}) == FaceFault::repeated_corner);
    CHECK(fault_of(faces(corner_triangle(), {{0, 1, 1}})) == FaceFault::repeated_corner);
    // Three places are enough.
    const SurfaceReport health = checked(one_face({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    CHECK(health.n_usable() == 1);
    CHECK(health.repeated_corner_faces == std::vector<std::int32_t>{0});
    CHECK(health.n_edges == 3);
}

TEST_CASE("a triangle whose corners are exactly collinear has no area", "[geometry][health]") {
    CHECK(fault_of_corners({{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}) == FaceFault::zero_area);
    CHECK(fault_of_corners({{0, 0, 0}, {1, 2, 3}, {-2, -4, -6}}) == FaceFault::zero_area);
    CHECK(fault_of_corners({{0.5, 0.5, 0}, {12.0, 12.0, 0}, {24.0, 24.0, 0}}) == FaceFault::zero_area);
    CHECK(fault_of_corners({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}) == FaceFault::zero_area);
    // One unit in the last place aside, and it is a face.
    CHECK(fault_of_corners({{0.5, 0.5, 0}, {12.0, std::nextafter(12.0, 13.0), 0}, {24.0, 24.0, 0}}) == FaceFault::none);
}

TEST_CASE("a needle of aspect 1e12 is usable, and counted as a sliver of that decade", "[geometry][health]") {
    const SurfaceReport health = checked(one_face({{0, 0, 0}, {1, 0, 0}, {0.5, 0.5e-12, 0}}));
    CHECK(health.n_usable() == 1);
    CHECK(health.worst_aspect == Approx(2e12));
    CHECK(health.worst_aspect_face == 0);
    CHECK(health.slivers == std::vector<std::int32_t>{0});
    CHECK(health.aspect_decades[12] == 1);
}

TEST_CASE("aspect ratios are longest edge over smallest height", "[geometry][health]") {
    CHECK(aspect_ratio(regular_polygon(3)) == Approx(2.0 / std::sqrt(3.0)));
    CHECK(aspect_ratio(one_face({{0, 0, 0}, {5, 0, 0}, {5, 1, 0}, {0, 1, 0}}).vertices) == Approx(5.0));
    Faces both = one_face({{0, 0, 0}, {1, 0, 0}, {0.5, 0.02, 0}});
    append(both, one_face(corner_triangle()), {0, 0, 1});
    SurfaceReport health = checked(both, {.sliver_aspect = 49.0});
    CHECK(health.slivers == std::vector<std::int32_t>{0});
    CHECK(health.worst_aspect == Approx(50.0));
    CHECK(health.aspect_decades[0] == 1);
    CHECK(health.aspect_decades[1] == 1);
    CHECK(checked(both, {.sliver_aspect = 51.0}).slivers.empty());
}

TEST_CASE("a bow-tie is told from a polygon that is not convex", "[geometry][health]") {
    CHECK(fault_of_corners({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}) == FaceFault::crossing);          // lobes cancel
    CHECK(fault_of_corners({{0, 0, 0}, {2, 0, 0}, {0.9, 1.2, 0}, {1.1, 1.2, 0}}) == FaceFault::crossing);  // or not
    CHECK(fault_of_corners({{0, 0, 1}, {0, 1, 2}, {0, 1, 1}, {0, 0, 2}}) == FaceFault::crossing);          // any plane
    CHECK(fault_of_corners({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}) == FaceFault::non_convex);
    std::vector<Vector<3>> star;
    const auto pentagon = regular_polygon(5);
    for (const std::size_t i : {0u, 2u, 4u, 1u, 3u}) star.push_back(pentagon[i]);
    CHECK(fault_of_corners(star) == FaceFault::crossing);
    // Around twice: convex by every edge, and yet no polygon.
    const auto once = regular_polygon(3);
    CHECK(fault_of_corners({once[0], once[1], once[2], once[0], once[1], once[2]}) == FaceFault::crossing);
}

TEST_CASE("a polygon with straight corners is usable", "[geometry][health]") {
    CHECK(fault_of_corners({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}) == FaceFault::none);
}

TEST_CASE("a polygon that is not flat is usable and listed with its deviation", "[geometry][health]") {
    // One corner lifted by h: the corners lie h/4 on either side of the plane through the centroid, tilted by O(h).
    const double h = 1e-3;
    Faces soup = one_face({{0, 0, 0}, {1, 0, 0}, {1, 1, h}, {0, 1, 0}});
    append(soup, one_face({{0, 0, 0}, {1, 0, 0}, {1, 1, 1e-12}, {0, 1, 0}}), {0, 0, 5});
    const SurfaceReport health = checked(soup);
    CHECK(health.n_usable() == 2);
    CHECK(health.non_planar_faces == std::vector<std::int32_t>{0});
    CHECK(health.worst_planarity == Approx(h / 4).epsilon(1e-3));
    CHECK(health.worst_planarity_face == 0);
    CHECK_FALSE(health.sound());
}

TEST_CASE("the second of two equal faces is a duplicate, from whichever corner it starts", "[geometry][health]") {
    const Faces soup = faces(corner_triangle(), {{0, 1, 2}, {1, 2, 0}, {0, 1, 2}});
    CHECK(face_faults(soup.soup()) == std::vector{FaceFault::none, FaceFault::duplicate, FaceFault::duplicate});
    Faces apart = one_face(corner_triangle());
    append(apart, one_face(corner_triangle()), Vector<3>::Zero());  // other indices, same positions
    CHECK(fault_of(apart, 1) == FaceFault::duplicate);
    CHECK(fault_of(faces(corner_triangle(), {{0, 1, 9}, {0, 1, 9}}), 1) == FaceFault::index_out_of_range);
}

TEST_CASE("a face that repeats another the other way round is usable and reported by itself", "[geometry][health]") {
    const SurfaceReport health =
        checked(faces(corner_triangle(), {{0, 1, 2}, {0, 2, 1}, {2, 1, 0}}), {.self_intersections = true});
    CHECK(health.n_usable() == 2);
    CHECK(health.faults[2] == FaceFault::duplicate);  // of the flipped one
    REQUIRE(health.flipped_duplicates.size() == 1);
    CHECK(health.flipped_duplicates[0].face == 1);
    CHECK(health.flipped_duplicates[0].earlier == 0);
    CHECK(health.n_self_intersections == 0);
    CHECK_FALSE(health.sound());
}
