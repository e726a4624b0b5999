// Facets of one piece that lie inside of each other at rest.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::NodalContact;

namespace {

/// A shaft of `n` flat sides in a bore of the same sides, of radius 1; each second side is twice as long as the others.
NodalScene<2> shaft_in_bore(int n, double depth) {
    NodalScene<2> scene;
    scene.faces.stiffness = {3.0, 3.0};
    for (const std::int32_t body : {0, 1})
        for (int i = 0; i < n; ++i) {
            const double angle = 4.0 * std::numbers::pi * (i / 2 + (i % 2 == 0 ? 0.0 : 1.0 / 3.0)) / n;
            scene.rest.emplace_back(std::cos(angle), std::sin(angle));
            std::vector<std::int32_t> side{n * body + i, n * body + (i + 1) % n};
            if (body == 1) std::ranges::reverse(side);  // its outside is that of the bore
            scene.faces.append_face(side, depth, body);
        }
    return scene;
}

/// The shaft turned, and thicker by 0.01.
std::vector<Vector<2>> turned_shaft(const NodalScene<2>& scene, double angle) {
    std::vector<Vector<2>> x = scene.rest;
    const double cos = 1.01 * std::cos(angle), sin = 1.01 * std::sin(angle);
    for (std::size_t i = 0; i < x.size() / 2; ++i) x[i] = {cos * x[i][0] - sin * x[i][1], sin * x[i][0] + cos * x[i][1]};
    return x;
}

}  // namespace

TEST_CASE("a shaft that was one piece with its bore bears in each step as one that never was, as it turns by two sides",
          "[contact][nodal]") {
    const int n = GENERATE(12, 40);
    const double depth = GENERATE(0.2, 0.05);
    CAPTURE(n, depth);
    const NodalScene<2> scene = shaft_in_bore(n, depth);
    contact::NodalOptions options;
    options.search.skin = 0.05;
    options.search.largest_motion = 100.0;
    NodalContact<2> never(scene.surface(), options);
    options.pieces = {0, 0};
    NodalContact<2> contact(scene.surface(), options);
    const auto energies_differ = [&](PointsView<2> x_0, PointsView<2> x_1) {
        return contact.step(1.0, x_0, x_1).energy != never.step(1.0, x_0, x_1).energy;
    };
    CHECK_FALSE(energies_differ(scene.rest, scene.rest));
    CHECK_FALSE(energies_differ(scene.rest, turned_shaft(scene, 0.0)));
    const double pressed = contact.last().energy;
    CHECK(pressed == Approx(0.5 * 1.5 * 0.01 * 0.01 * 2.0 * std::numbers::pi).epsilon(0.2));  // that of round ones
    const int steps = 50;
    const double sides = 4.0 * std::numbers::pi / n;
    int differing = 0;
    for (int i = 0; i < steps; ++i)
        differing += energies_differ(turned_shaft(scene, sides * i / steps), turned_shaft(scene, sides * (i + 1) / steps));
    CHECK(differing == 0);
    CHECK(contact.last().energy == Approx(pressed).epsilon(1e-9));
    CHECK(contact.report().missed_contacts == 0);
}
