// Faces near the sharp edges of a body, and along whose normal they meet others.
#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "abut/contact/overlap/overlaps.hpp"
#include "abut/contact/surface/sharp_edges.hpp"
#include "contact/law.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using contact::steps_to_sharp_edge;

namespace {

/// A rectangle (2D) whose sides are cut into n faces each, of body 0; counter-clockwise from its lower left corner.
contact::Surface<2> rectangle(int n) {
    contact::Surface<2> surface;
    const std::array<Vector<2>, 4> corners{Vector<2>(0, 0), Vector<2>(1, 0), Vector<2>(1, 1), Vector<2>(0, 1)};
    for (std::size_t side = 0; side < 4; ++side)
        for (int i = 0; i < n; ++i) {
            const Vector<2>&a = corners[side], &b = corners[(side + 1) % 4];
            const auto at = [&](int k) -> Vector<2> { return a + static_cast<double>(k) / n * (b - a); };
            surface.append(std::array{at(i), at(i + 1)}, 0.1, 1.0, 0);
        }
    return surface;
}

/// A regular polygon of n sides.
contact::Surface<2> polygon(int n) {
    contact::Surface<2> surface;
    const auto at = [&](int k) {
        const double angle = 2.0 * std::numbers::pi * (k % n) / n;
        return Vector<2>(std::cos(angle), std::sin(angle));
    };
    for (int k = 0; k < n; ++k) surface.append(std::array{at(k), at(k + 1)}, 0.1, 1.0, 0);
    return surface;
}

}  // namespace

TEST_CASE("steps to a sharp edge are counted from face to face, and no farther than matters", "[contact][edges]") {
    constexpr int n = 10;
    const auto surface = rectangle(n);
    const auto steps = steps_to_sharp_edge<2>(surface.view());
    for (int face = 0; face < 4 * n; ++face) {
        const int index = face % n;
        CHECK(steps[static_cast<std::size_t>(face)] ==
              std::min({index, n - 1 - index, static_cast<int>(contact::far_from_sharp_edge)}));
    }
}

TEST_CASE("round surfaces have no sharp edges, polygons of up to six sides do, and neither has an inner corner",
          "[contact][edges]") {
    const int n = GENERATE(3, 4, 5, 6, 7, 8, 20);
    auto surface = polygon(n);
    const auto is_near = [](std::uint8_t steps) { return steps < contact::far_from_sharp_edge; };
    const auto outside = steps_to_sharp_edge<2>(surface.view());
    CHECK(std::ranges::all_of(outside, is_near) == (n <= 6));
    CHECK(std::ranges::none_of(outside, is_near) == (n > 6));
    for (Vector<2>& normal : surface.normal) normal = -normal;  // a hole of that shape
    CHECK(std::ranges::none_of(steps_to_sharp_edge<2>(surface.view()), is_near));
}

TEST_CASE("the rim of an open surface is no edge, and two bodies have no edge in common", "[contact][edges]") {
    const auto flat = sheet(4, 0, true, [](double, double) { return 0.0; });
    for (const std::uint8_t steps : steps_to_sharp_edge<3>(flat.view())) CHECK(steps == contact::far_from_sharp_edge);

    const auto roof = sheet(4, 0, true, [](double x, double) { return -3.0 * std::abs(x - 0.5); });
    auto halves = roof;
    for (std::int32_t face = 0; face < halves.size(); ++face) halves.body[face] = halves.centroid[face].x() < 0.5 ? 0 : 1;
    const auto steps = steps_to_sharp_edge<3>(roof.view()), of_halves = steps_to_sharp_edge<3>(halves.view());
    for (std::int32_t face = 0; face < roof.size(); ++face) {
        const double from_ridge = 4.0 * std::abs(roof.centroid[face].x() - 0.5);  // in squares of two triangles each
        CHECK(steps[face] == (from_ridge < 1.0 ? (from_ridge < 0.5 ? 0 : 1) : 2 + (from_ridge > 1.5)));
        CHECK(of_halves[face] == contact::far_from_sharp_edge);
    }
}

TEMPLATE_TEST_CASE_SIG(
    "two faces of one size meet along the normal of the one that is farther from a sharp edge, or the mean of both",
    "[contact][edges]", ((int Dim), Dim), 2, 3) {
    Vector<Dim> slanted = -up<Dim>();
    slanted[0] = 1.0;  // 45 degrees
    contact::Surface<Dim> surface;
    surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.5, 1.0, 0);
    surface.append(tile<Dim>(Vector<Dim>(0.1 * up<Dim>()), slanted.normalized(), 0.45), 0.3, 1.0, 1);
    const auto normal = [&](std::uint8_t steps_0, std::uint8_t steps_1) -> Vector<Dim> {
        surface.steps_to_sharp_edge = {steps_0, steps_1};
        const std::vector<geometry::IndexPair> pair{{0, 1}};
        const auto overlaps = contact::find_overlaps<Dim>(surface.view(), at_rest(surface), pair);
        REQUIRE(overlaps.found.size() == 1);
        return overlaps.found.front().normal;
    };
    CHECK((normal(3, 0) - up<Dim>()).norm() < 1e-15);
    CHECK((normal(2, 1) - up<Dim>()).norm() < 1e-15);
    CHECK((normal(0, 1) + slanted.normalized()).norm() < 1e-15);
    CHECK((normal(1, 1) - (up<Dim>() - slanted.normalized()).normalized()).norm() < 1e-15);
}

TEMPLATE_TEST_CASE_SIG("pairs whose normal is more than 20 degrees away from those of both faces are counted",
                       "[contact][edges]", ((int Dim), Dim), 2, 3) {
    const auto tilted_pairs = [](double degrees, std::uint8_t steps_0, std::uint8_t steps_1) {
        const double angle = degrees * std::numbers::pi / 180.0;
        contact::Surface<Dim> surface;
        surface.append(tile<Dim>(Vector<Dim>::Zero(), up<Dim>(), 0.5), 0.5, 1.0, 0);
        surface.append(
            tile<Dim>(Vector<Dim>(-0.1 * up<Dim>()), -std::cos(angle) * up<Dim>() + std::sin(angle) * axis<Dim>(0), 0.5),
            0.5, 1.0, 1);
        surface.steps_to_sharp_edge = {steps_0, steps_1};
        contact::PairList<Dim> list;
        list.append(surface.view(), 0, 1, contact::InterfaceWeighting::half);
        const std::vector<contact::Face> faces{contact::Face{0}, contact::Face{1}};
        list.number_faces(faces);
        const std::vector<Vector<Dim>> zero(2, Vector<Dim>::Zero());
        LawOnList<Dim> law({});
        const auto& step =
            law(surface.view(), list, {{.admitted = true}}, faces, uncoupled<Dim>(2), {zero, zero, zero, zero});
        REQUIRE(step.pairs.size() == 1);
        return step.report.tilted_pairs;
    };
    CHECK(tilted_pairs(38.0, 1, 1) == 0);
    CHECK(tilted_pairs(45.0, 1, 1) == 1);
    CHECK(tilted_pairs(45.0, 3, 0) == 0);
}

TEST_CASE("steps to sharp edges come one per face, or the surface is refused", "[contact][edges][bad-input]") {
    auto surface = rectangle(3);
    surface.steps_to_sharp_edge = {0, 1};
    CHECK_THROWS_WITH(contact::check(surface.view()), Catch::Contains("steps_to_sharp_edge") && Catch::Contains("12"));
    surface.steps_to_sharp_edge.assign(12, 0);
    surface.steps_to_sharp_edge[7] = contact::far_from_sharp_edge + 1;
    CHECK_THROWS_WITH(contact::check(surface.view()), Catch::Contains("face 7") && Catch::Contains("4 steps"));
}
