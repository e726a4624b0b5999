// Sharp edges of bodies in space under the pair potential: strips of their own across the edges.
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "abut/base/rotation.hpp"

#include "contact/nodal_scenes.hpp"

using namespace abut;
using namespace abut::test;
using contact::NodalContact;
using contact::NodalStep;

namespace {

constexpr double one_degree = std::numbers::pi / 180.0;
constexpr double stiffness_of_prism = 3.0, stiffness_of_block = 5.0, series_of_both = 15.0 / 8.0;
constexpr double depth_of_both = 0.1, prism_height = 0.5, prism_length = 0.4;

/// A prism along x with its sharp edge below, at z = 0, the middle of the edge at the origin.
void append_prism(NodalScene<3>& scene, double angle) {
    scene.faces.stiffness.push_back(stiffness_of_prism);
    const std::int32_t body = scene.n_bodies() - 1, first = static_cast<std::int32_t>(scene.rest.size());
    const double half = prism_height * std::tan(0.5 * angle);
    for (const double x : {-0.5 * prism_length, 0.5 * prism_length})
        for (const Vector<2>& yz : {Vector<2>(0.0, 0.0), Vector<2>(half, prism_height), Vector<2>(-half, prism_height)}) {
            scene.rest.push_back({x, yz[0], yz[1]});
            scene.node_body.push_back(body);
        }
    for (const auto& face :
         std::vector<std::vector<std::int32_t>>{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}}) {
        std::vector<std::int32_t> corners;
        for (const std::int32_t corner : face) corners.push_back(first + corner);
        scene.faces.append_face(corners, depth_of_both, body);
    }
}

/// A prism over a block of one face per side: bodies 0 and 1.
NodalScene<3> edge_on_block(double angle, double stiffness = stiffness_of_block) {
    NodalScene<3> scene;
    append_prism(scene, angle);
    append_box<3>(scene, {-1.0, -1.1, -1.0}, {1.1, 1.0, 0.0}, {1, 1, 1}, stiffness,
                  std::isfinite(stiffness) ? depth_of_both : 0.0);
    return scene;
}
/// Two prisms, edge over edge, at right angles: body 1 below.
NodalScene<3> crossing_edges(double angle_1, double angle_2) {
    NodalScene<3> scene;
    append_prism(scene, angle_1);
    const std::size_t first = scene.rest.size();
    append_prism(scene, angle_2);
    for (std::size_t i = first; i < scene.rest.size(); ++i) {
        const Vector<3> x = scene.rest[i];
        scene.rest[i] = {x[1], x[0], -x[2]};  // a rotation
    }
    return scene;
}
std::vector<Vector<3>> placed_at(const NodalScene<3>& scene, double z, double turn = 0.0) {
    return placed<3>(scene, 0, {rotation_about(Vector<3>::UnitX(), turn), Vector<3>(0.013, 0.017, z)});
}
/// Presses body 0 in from above.
NodalStep<3> pressed_in(const NodalScene<3>& scene, NodalContact<3>& contact, double by, double turn = 0.0) {
    contact.step(1.0, placed_at(scene, 1e-3, turn), placed_at(scene, -by, turn));
    return contact.evaluate(placed_at(scene, -by, turn));
}
/// Of a flank, from the edge to its other side.
double flank(double angle) { return prism_height / std::cos(0.5 * angle); }

}  // namespace

// Flanks see the flat side at n_1 . n_2 = -sin(angle/2) > -0.2, and do not act.
TEST_CASE("an edge that is pressed straight into a flat side has the energy k L g^2/2 of the rim of its flanks, per length",
          "[contact][bevels]") {
    const double angle = GENERATE(5.0, 10.0, 20.0) * one_degree, by = GENERATE(1e-3, 1e-2);
    const bool block_is_rigid = GENERATE(false, true);
    const NodalScene<3> scene =
        edge_on_block(angle, block_is_rigid ? std::numeric_limits<double>::infinity() : stiffness_of_block);
    NodalContact<3> contact(scene.surface());
    const auto step = pressed_in(scene, contact, by);
    const double k = block_is_rigid ? stiffness_of_prism : series_of_both;
    CHECK(step.energy == Approx(0.5 * k * flank(angle) * prism_length * by * by).epsilon(1e-9));
    const auto force = forces<3>(step, scene.rest.size());
    Vector<3> on_edge = Vector<3>::Zero();
    for (std::size_t node = 0; node < force.size(); ++node)
        if (scene.node_body[node] == 0) on_edge += force[node];
    CHECK(on_edge[2] == Approx(k * flank(angle) * prism_length * by).epsilon(1e-9));
    CHECK(contact.report().missed_contacts == 0);
}

TEST_CASE("edges that cross at right angles have the energy k L_1 L_2 g^2/2 of the rims of their flanks",
          "[contact][bevels]") {
    const auto [angle_1, angle_2] = GENERATE(table<double, double>({{20.0, 20.0}, {10.0, 22.0}}));
    const double by = GENERATE(1e-3, 1e-2);
    const NodalScene<3> scene = crossing_edges(angle_1 * one_degree, angle_2 * one_degree);
    NodalContact<3> contact(scene.surface());
    const auto step = pressed_in(scene, contact, by);
    CHECK(step.energy ==
          Approx(0.5 * 0.5 * stiffness_of_prism * flank(angle_1 * one_degree) * flank(angle_2 * one_degree) * by * by)
              .epsilon(1e-9));
}

TEST_CASE("nodes of the host get the gradient of W, though strips across edges have corners of their own",
          "[contact][bevels]") {
    const bool crosses = GENERATE(false, true);
    const double angle = GENERATE(20.0, 45.0) * one_degree, turn = GENERATE(0.0, 0.1);
    const NodalScene<3> scene = crosses ? crossing_edges(angle, 80.0 * one_degree) : edge_on_block(angle);
    NodalContact<3> contact(scene.surface());
    const NodalStep<3> step = pressed_in(scene, contact, 0.02, turn);
    REQUIRE(step.is_active());
    CHECK(step.nodes.back() < scene.surface().n_nodes());
    const auto force = forces<3>(step, scene.rest.size());
    const auto x = placed_at(scene, -0.02, turn);
    double largest = 0.0;
    for (const Vector<3>& f : force) largest = std::max(largest, f.norm());
    for (std::size_t node = 0; node < x.size(); ++node)
        for (int d = 0; d < 3; ++d) {
            constexpr double h = 1e-7;
            const auto energy = [&](double by) {
                auto moved = x;
                moved[node][d] += by;
                return contact.evaluate(moved).energy;
            };
            CHECK(-force[node][d] == Approx((energy(h) - energy(-h)) / (2.0 * h)).margin(1e-6 * largest));
        }
}

TEST_CASE("a flank that rests on a flat side is pressed by k |g| all over, and the strip beside it does nothing",
          "[contact][bevels]") {
    const double angle = GENERATE(20.0, 45.0, 80.0, 90.0) * one_degree, by = GENERATE(1e-4, 1e-2);
    const NodalScene<3> scene = edge_on_block(angle);
    NodalContact<3> contact(scene.surface());
    const auto step = pressed_in(scene, contact, by, 0.5 * std::numbers::pi - 0.5 * angle);
    CHECK(step.energy == Approx(0.5 * series_of_both * flank(angle) * prism_length * by * by).epsilon(1e-9));
}

TEST_CASE("boxes have no strips across their edges; edges below 60 degrees have, and those that cross another body's unseen",
          "[contact][bevels]") {
    CHECK(NodalContact<3>(two_boxes<3>(2, 3, 0.1).surface()).bevel_width() == 0.0);
    CHECK(NodalContact<3>(edge_on_block(50.0 * one_degree).surface()).bevel_width() > 0.0);
    CHECK(NodalContact<3>(crossing_edges(60.0 * one_degree, 60.0 * one_degree).surface()).bevel_width() > 0.0);
}

TEST_CASE("edges and corners that have a strip of their own are neither unseen nor blind", "[contact][bevels]") {
    const NodalContact<3> contact(crossing_edges(20.0 * one_degree, 90.0 * one_degree).surface());
    CHECK_FALSE(contact.unseen_edges());
}

TEST_CASE(
    "a run with strips across edges goes on from a saved state with the same bits, and from a surface that is replaced "
    "by itself",
    "[contact][bevels]") {
    const NodalScene<3> scene = crossing_edges(30.0 * one_degree, 80.0 * one_degree);
    const auto at = [&](int i) { return placed_at(scene, 0.005 - 0.001 * i); };
    NodalContact<3> whole(scene.surface()), first(scene.surface());
    for (int i = 0; i < 12; ++i) {
        whole.step(1.0, at(i), at(i + 1));
        first.step(1.0, at(i), at(i + 1));
    }
    REQUIRE(whole.last().is_active());
    NodalContact<3> restored(scene.surface()), replaced(scene.surface());
    restored.restore(first.state());
    replaced.restore(first.state());
    std::vector<std::int32_t> same;
    for (std::int32_t face = 0; face < scene.surface().n_faces(); ++face) same.push_back(face);
    replaced.surface_replaced(scene.surface(), same);
    for (int i = 12; i < 16; ++i) {
        const auto& expected = whole.step(1.0, at(i), at(i + 1));
        for (NodalContact<3>* other : {&restored, &replaced}) {
            const auto& step = other->step(1.0, at(i), at(i + 1));
            CHECK(step.energy == expected.energy);
            CHECK(forces<3>(step, scene.rest.size()) == forces<3>(expected, scene.rest.size()));
        }
    }
}
