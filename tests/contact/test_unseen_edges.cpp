// Edges that cross and that contact cannot see.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/contact/surface/unseen_edges.hpp"
#include "abut/geometry/polygon.hpp"
#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::test;
using contact::unseen_edges;

namespace {

constexpr double pi = std::numbers::pi;

/// A beam along an axis whose section is a rhombus with this angle [rad] above and below; its sides are squares of 1 m.
void append_beam(contact::Surface<3>& surface, const Vector<3>& axis, double angle, std::int32_t body, double height,
                 double stiffness = 1.0) {
    const Vector<3> across = Vector<3>::UnitZ().cross(axis), up = Vector<3>::UnitZ(), middle = height * up;
    const std::array<Vector<3>, 4> section{middle - std::cos(0.5 * angle) * up, middle + std::sin(0.5 * angle) * across,
                                           middle + std::cos(0.5 * angle) * up, middle - std::sin(0.5 * angle) * across};
    for (std::size_t i = 0; i < 4; ++i) {
        const Vector<3>&a = section[i], &b = section[(i + 1) % 4];
        std::vector<Vector<3>> corners{a - 0.5 * axis, b - 0.5 * axis, b + 0.5 * axis, a + 0.5 * axis};
        const Vector<3> outward = 0.5 * (a + b) - middle;
        if (geometry::face_normal<3>(corners).dot(outward) < 0.0) std::ranges::reverse(corners);
        surface.append(corners, 0.2, stiffness, body);
    }
}

/// How much the faces of two bodies look at each other at most.
double most_facing(const contact::Surface<3>& surface) {
    double most = -1.0;
    for (std::int32_t i = 0; i < surface.size(); ++i)
        for (std::int32_t j = 0; j < surface.size(); ++j)
            if (surface.body[i] != surface.body[j] && surface.normal[i].z() > 0.0 && surface.normal[j].z() < 0.0)
                most = std::max(most, -surface.normal[i].dot(surface.normal[j]));
    return most;
}

}  // namespace

TEST_CASE("edges that cross are unseen where the sines of half their angles are too small together", "[contact][edges]") {
    const double angle_1 = GENERATE(30.0, 50.0, 60.0, 90.0) * pi / 180.0, angle_2 = GENERATE(20.0, 60.0, 100.0) * pi / 180.0;
    contact::Surface<3> surface;
    append_beam(surface, Vector<3>::UnitX(), angle_1, 0, 0.0);
    append_beam(surface, Vector<3>::UnitY(), angle_2, 1, 3.0);
    const double facing = std::min(std::sin(0.5 * angle_1), std::cos(0.5 * angle_1)) *
                          std::min(std::sin(0.5 * angle_2), std::cos(0.5 * angle_2));  // the sharper edges of each rhombus
    const auto always = unseen_edges<3>(surface.view(), -0.9999);
    REQUIRE(always);
    CHECK(always->facing() == Approx(facing).epsilon(1e-12));
    CHECK(unseen_edges<3>(surface.view(), -facing - 1e-6).has_value());
    CHECK_FALSE(unseen_edges<3>(surface.view(), -facing + 1e-6).has_value());
    if (angle_1 <= 0.5 * pi && angle_2 <= 0.5 * pi) CHECK(most_facing(surface) == Approx(facing).epsilon(1e-12));
}

TEST_CASE("edges of 60 degrees are seen by default, edges of 50 are not, and the sharpest are named", "[contact][edges]") {
    contact::Surface<3> surface;
    append_beam(surface, Vector<3>::UnitX(), 60.0 * pi / 180.0, 0, 0.0);
    append_beam(surface, Vector<3>::UnitY(), 60.0 * pi / 180.0, 1, 3.0);
    const double by_default = contact::CandidateOptions{}.facing_cosine;
    CHECK_FALSE(unseen_edges<3>(surface.view(), by_default));
    append_beam(surface, Vector<3>::UnitY(), 44.0 * pi / 180.0, 2, 6.0);
    const auto unseen = unseen_edges<3>(surface.view(), by_default);
    REQUIRE(unseen);
    CHECK(unseen->edge_1.body == 2);
    CHECK(unseen->edge_1.half_angle_sine == Approx(std::sin(22.0 * pi / 180.0)));
    CHECK(std::abs(std::abs(unseen->edge_1.midpoint.z() - 6.0) - std::cos(22.0 * pi / 180.0)) < 1e-12);
    CHECK(unseen->edge_2.half_angle_sine == Approx(0.5));
}

TEST_CASE("rigid bodies, edges that turn inwards and surfaces in the plane have no unseen edges", "[contact][edges]") {
    contact::Surface<3> both_rigid;
    append_beam(both_rigid, Vector<3>::UnitX(), 0.3, 0, 0.0, rigid);
    append_beam(both_rigid, Vector<3>::UnitY(), 0.3, 1, 3.0, rigid);
    CHECK_FALSE(unseen_edges<3>(both_rigid.view(), -0.2));
    append_beam(both_rigid, Vector<3>::UnitY(), 0.3, 2, 6.0);
    CHECK(unseen_edges<3>(both_rigid.view(), -0.2));  // one of the two is enough

    contact::Surface<3> grooves;  // two roofs, open side up: their only edge is a valley
    for (std::int32_t body = 0; body < 2; ++body) {
        const double z = 3.0 * body;
        grooves.append(std::vector<Vector<3>>{{0, 0, z}, {1, 0, z}, {1, 0.1, z + 1}, {0, 0.1, z + 1}}, 0.2, 1.0, body);
        grooves.append(std::vector<Vector<3>>{{1, 0, z}, {0, 0, z}, {0, -0.1, z + 1}, {1, -0.1, z + 1}}, 0.2, 1.0, body);
    }
    CHECK_FALSE(unseen_edges<3>(grooves.view(), -0.2));
    CHECK_FALSE(unseen_edges<2>(contact::Surface<2>{}.view(), -0.2));
}
