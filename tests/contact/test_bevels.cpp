// Sharp corners under the pair potential: a facet of their own across the tip.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "abut/base/rotation.hpp"

#include "contact/nodal_scenes.hpp"
#include "contact/triangle_host.hpp"

using namespace abut;
using namespace abut::test;
using contact::NodalContact;
using contact::NodalStep;

namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double tip_stiffness = 3.0, block_stiffness = 5.0, series = 15.0 / 8.0;
constexpr double depth = 0.1;
constexpr double edge = 0.5;  // length of both flanks of a tip

/// A triangle with its tip down at the origin, body 0, and a block of one face per side under it, body 1.
struct TipOnBlock {
    explicit TipOnBlock(double angle, double block = block_stiffness) {
        scene.faces.stiffness.push_back(tip_stiffness);
        scene.rest = {{0.0, 0.0},
                      edge * Vector<2>(std::sin(0.5 * angle), std::cos(0.5 * angle)),
                      edge * Vector<2>(-std::sin(0.5 * angle), std::cos(0.5 * angle))};
        scene.node_body = {0, 0, 0};
        for (const auto& face : {std::array{0, 1}, {1, 2}, {2, 0}})
            scene.faces.append_face(std::vector<std::int32_t>{face[0], face[1]}, depth, 0);
        append_box<2>(scene, {-1.0, -1.0}, {1.0, 0.0}, {1, 1}, block, std::isfinite(block) ? depth : 0.0);
    }
    /// The tip at `at`, turned.
    [[nodiscard]] std::vector<Vector<2>> placed_at(const Vector<2>& at, double turn = 0.0) const {
        return placed<2>(scene, 0, {rotation_in_plane(turn), at});
    }
    NodalScene<2> scene;
};

/// Presses the tip in from above.
NodalStep<2> pressed_in(const TipOnBlock& bodies, NodalContact<2>& contact, double by, double turn = 0.0) {
    contact.step(1.0, bodies.placed_at({0.1, 1e-3}, turn), bodies.placed_at({0.1, -by}, turn));
    return contact.evaluate(bodies.placed_at({0.1, -by}, turn));
}

TriangleHost tip_over_block(double angle, double size, double gap) {
    TriangleHost host;
    host.append(block_rows(1.5, 0.5, size, 0.3 * size));
    host.append(moved(tip_rows(angle, 1.0, 0.4, size), Matrix<2>::Identity(), {0.0, gap}));
    return host;
}
/// Of its upper side, from left to right.
std::vector<std::int32_t> upper_nodes(double size) {
    const auto n = static_cast<std::int32_t>(std::lround(1.5 / size)) + 1;
    const auto rows = static_cast<std::int32_t>(std::lround(0.5 / size)) + 1;
    std::vector<std::int32_t> nodes;
    for (std::int32_t i = n * (rows - 1); i < n * rows; ++i) nodes.push_back(i);
    return nodes;
}

}  // namespace

// Flanks see the flat side at n_1 . n_2 = -sin(angle/2) > -0.2, and do not act. k w of the bevel is k times the flank.
TEST_CASE("a tip that is pressed straight into a flat side has the energy k L g^2/2 of a corner of its flanks",
          "[contact][bevels]") {
    const double angle = GENERATE(5.0, 10.0, 20.0) * degree, by = GENERATE(1e-3, 1e-2);
    const bool block_is_rigid = GENERATE(false, true);
    const TipOnBlock bodies(angle, block_is_rigid ? std::numeric_limits<double>::infinity() : block_stiffness);
    NodalContact<2> contact(bodies.scene.surface());
    const auto step = pressed_in(bodies, contact, by);
    const double k = block_is_rigid ? tip_stiffness : series;
    CHECK(step.energy == Approx(0.5 * k * edge * by * by).epsilon(1e-9));
    const auto force = forces<2>(step, bodies.scene.rest.size());
    const Vector<2> on_tip = force[0] + force[1] + force[2];
    CHECK(on_tip[1] == Approx(k * edge * by).epsilon(1e-9));
    CHECK(std::abs(on_tip[0]) < 1e-12);
    CHECK(contact.report().missed_contacts == 0);
}

TEST_CASE("nodes of the host get the gradient of W, though a bevel has corners of its own", "[contact][bevels]") {
    const double angle = GENERATE(10.0, 30.0, 55.0) * degree, turn = GENERATE(0.0, 0.1);
    const TipOnBlock bodies(angle);
    NodalContact<2> contact(bodies.scene.surface());
    const NodalStep<2> step = pressed_in(bodies, contact, 0.02, turn);
    REQUIRE(step.is_active());
    CHECK(step.nodes.back() < bodies.scene.surface().n_nodes());
    CHECK(step.gradient.size() == step.nodes.size());
    const auto force = forces<2>(step, bodies.scene.rest.size());
    const auto x = bodies.placed_at({0.1, -0.02}, turn);
    double largest = 0.0;
    for (const Vector<2>& f : force) largest = std::max(largest, f.norm());
    for (std::size_t node = 0; node < x.size(); ++node)
        for (int d = 0; d < 2; ++d) {
            constexpr double h = 1e-7;
            const auto energy = [&](double by) {
                auto moved = x;
                moved[node][d] += by;
                return contact.evaluate(moved).energy;
            };
            CHECK(-force[node][d] == Approx((energy(h) - energy(-h)) / (2.0 * h)).margin(1e-6 * largest));
        }
}

TEST_CASE("a flank that rests on a flat side is pressed by k |g| along its length, and the bevel beside it does nothing",
          "[contact][bevels]") {
    const double angle = GENERATE(10.0, 30.0, 45.0, 59.0) * degree, by = GENERATE(1e-4, 1e-2);
    const TipOnBlock bodies(angle);
    NodalContact<2> contact(bodies.scene.surface());
    const auto step = pressed_in(bodies, contact, by, 0.5 * std::numbers::pi - 0.5 * angle);
    CHECK(step.energy == Approx(0.5 * series * edge * by * by).epsilon(1e-9));
    REQUIRE(step.pairs.size() == 1);
    CHECK(step.pairs[0].normal_force == Approx(series * edge * by).epsilon(1e-9));
}

TEST_CASE("a tip with a bevel is no blind corner", "[contact][bevels]") {
    CHECK(NodalContact<2>(TipOnBlock(20.0 * degree).scene.surface()).blind_corners().empty());
}

TEST_CASE(
    "tips of 10 to 60 degrees rebound from a flat side as their nodes do under a force of each, within 0.02 of the speed",
    "[contact][bevels]") {
    constexpr double size = 1.0 / 40.0;
    const double degrees = GENERATE(10.0, 25.0, 45.0, 59.9), speed = GENERATE(0.005, 0.02), aside = GENERATE(0.0, 1.0);
    CAPTURE(degrees, speed, aside);
    const TriangleHost host = tip_over_block(degrees * degree, size, 0.2 * speed);
    const std::array<Vector<2>, 2> velocity{Vector<2>::Zero(), Vector<2>(aside * speed, -speed)};
    const Collision found = collide(host, velocity, 6.0);
    const auto reference = collide_by_penalty(host, velocity, 6.0, upper_nodes(size));
    CHECK((found.velocity[1] - reference[1]).norm() <= 0.02 * speed);
    CHECK(found.velocity[1][1] > 0.2 * speed);
    CHECK(found.excess <= (aside == 0.0 ? 2e-3 : 1e-2));
    CHECK(found.pseudo_drift <= 1e-12);
    CHECK(found.momentum_drift <= 3e-14);  // rounding of 600 steps
    CHECK(found.moment <= 1e-14);
    CHECK(found.missed == 0);
}

TEST_CASE("tips that meet tips beside each other are not pulled through each other, and conserve", "[contact][bevels]") {
    const auto [lower, upper] = GENERATE(table<double, double>({{25.0, 25.0}, {45.0, 45.0}, {30.0, 59.9}, {90.0, 59.9}}));
    const double shift = GENERATE(0.004, 0.01), speed = GENERATE(0.005, 0.02);
    CAPTURE(lower, upper, shift, speed);
    TriangleHost host;
    host.append(moved(tip_rows(lower * degree, 1.0, 0.4, 1.0 / 40.0), -Matrix<2>::Identity(), {0.0, 0.0}));
    host.append(moved(tip_rows(upper * degree, 1.0, 0.4, 1.0 / 40.0), Matrix<2>::Identity(), {shift, 0.2 * speed}));
    const Collision found = collide(host, {Vector<2>::Zero(), Vector<2>(0.0, -speed)}, 6.0);
    CHECK(found.velocity[1][0] > -1e-12 * speed);  // they may pass beside each other
    CHECK(found.excess <= 1e-2);
    CHECK(found.pseudo_drift <= 1e-12);
    CHECK(found.missed == 0);
}

TEST_CASE("a run with bevels goes on from a saved state with the same bits, and from a surface that is replaced by itself",
          "[contact][bevels]") {
    const TipOnBlock bodies(30.0 * degree);
    const auto at = [&](int i) { return bodies.placed_at({0.1, 0.005 - 0.001 * i}); };
    NodalContact<2> whole(bodies.scene.surface()), first(bodies.scene.surface());
    for (int i = 0; i < 12; ++i) {
        whole.step(1.0, at(i), at(i + 1));
        first.step(1.0, at(i), at(i + 1));
    }
    REQUIRE(whole.last().is_active());
    NodalContact<2> restored(bodies.scene.surface()), replaced(bodies.scene.surface());
    restored.restore(first.state());
    replaced.restore(first.state());
    std::vector<std::int32_t> same;
    for (std::int32_t face = 0; face < bodies.scene.surface().n_faces(); ++face) same.push_back(face);
    replaced.surface_replaced(bodies.scene.surface(), same);
    for (int i = 12; i < 16; ++i) {
        const auto& expected = whole.step(1.0, at(i), at(i + 1));
        for (NodalContact<2>* other : {&restored, &replaced}) {
            const auto& step = other->step(1.0, at(i), at(i + 1));
            CHECK(step.energy == expected.energy);
            CHECK(forces<2>(step, bodies.scene.rest.size()) == forces<2>(expected, bodies.scene.rest.size()));
        }
    }
}
