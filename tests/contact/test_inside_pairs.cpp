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

/// The corners of a shaft of `n` flat sides and radius 1; each second side is twice as long as the others.
std::vector<Vector<2>> corners_of_shaft(int n) {
    std::vector<Vector<2>> corners;
    for (int i = 0; i < n; ++i) {
        const double angle = 4.0 * std::numbers::pi * (i / 2 + (i % 2 == 0 ? 0.0 : 1.0 / 3.0)) / n;
        corners.emplace_back(std::cos(angle), std::sin(angle));
    }
    return corners;
}

void append(NodalScene<2>& scene, std::int32_t first, std::int32_t second, double depth, std::int32_t body) {
    if (body == 0) return scene.faces.append_face(std::vector<std::int32_t>{first, second}, depth, body);
    scene.faces.append_face(std::vector<std::int32_t>{second, first}, depth, body);
}
/// Two triangles over the side, from the corner of a number at z = 0 to the next number at z = 1.
void append(NodalScene<3>& scene, std::int32_t first, std::int32_t second, double depth, std::int32_t body) {
    for (std::vector<std::int32_t> corners :
         {std::vector{2 * first, 2 * second, 2 * second + 1}, std::vector{2 * first, 2 * second + 1, 2 * first + 1}}) {
        if (body == 1) std::ranges::reverse(corners);
        scene.faces.append_face(corners, depth, body);
    }
}

/// That shaft in a bore of the same sides, whose outside is the other one. In space both are 1 long.
template <int Dim>
NodalScene<Dim> shaft_in_bore(int n, double depth) {
    NodalScene<Dim> scene;
    scene.faces.stiffness = {3.0, 3.0};
    for (const std::int32_t body : {0, 1}) {
        for (const Vector<2>& corner : corners_of_shaft(n))
            for (int end = 0; end < Dim - 1; ++end) {
                Vector<Dim> x = Vector<Dim>::Zero();
                for (int i = 0; i < 2; ++i) x[i] = corner[i];
                x[Dim - 1] = Dim == 2 ? corner[1] : end;
                scene.rest.push_back(x);
            }
        for (int i = 0; i < n; ++i) append(scene, n * body + i, n * body + (i + 1) % n, depth, body);
    }
    return scene;
}

/// The shaft turned, and thicker by 0.01.
template <int Dim>
std::vector<Vector<Dim>> turned_shaft(const NodalScene<Dim>& scene, double angle) {
    std::vector<Vector<Dim>> x = scene.rest;
    const double cos = 1.01 * std::cos(angle), sin = 1.01 * std::sin(angle);
    for (std::size_t i = 0; i < x.size() / 2; ++i) {
        const Vector<Dim> at = x[i];
        x[i][0] = cos * at[0] - sin * at[1];
        x[i][1] = sin * at[0] + cos * at[1];
    }
    return x;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a shaft that was one piece with its bore bears in each step as one that never was, as it turns by two sides",
    "[contact][nodal]", ((int Dim), Dim), 2, 3) {
    const int n = GENERATE(12, 40);
    const double depth = GENERATE(0.2, 0.05);
    CAPTURE(n, depth);
    const NodalScene<Dim> scene = shaft_in_bore<Dim>(n, depth);
    contact::NodalOptions options;
    options.search.skin = 0.05;
    options.search.largest_motion = 100.0;
    NodalContact<Dim> never(scene.surface(), options);
    options.pieces = {0, 0};
    NodalContact<Dim> contact(scene.surface(), options);
    const auto energies_differ = [&](PointsView<Dim> x_0, PointsView<Dim> x_1) {
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
