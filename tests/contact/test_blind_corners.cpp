#include "abut/contact/surface/blind_corners.hpp"

#include <catch2/catch.hpp>

#include "contact/surfaces.hpp"

using namespace abut;
using namespace abut::contact;

namespace {

constexpr double pi = std::numbers::pi;

/// The boundary of a triangle whose tip at the origin has this angle [rad], turned; its base is `1` away.
Surface<2> wedge(double angle, double turn) {
    const auto at = [&](double x, double y) {
        return Vector<2>(std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y);
    };
    const double half = std::tan(0.5 * angle);
    const std::array corners{at(0, 0), at(half, 1), at(-half, 1)};
    const Vector<2> inside = (corners[0] + corners[1] + corners[2]) / 3.0;
    Surface<2> surface;
    for (std::size_t i = 0; i < 3; ++i) {
        std::array face{corners[i], corners[(i + 1) % 3]};
        surface.append(face, 0.1, 1.0, 0);
        if (surface.normal.back().dot(surface.centroid.back() - inside) < 0.0) surface.normal.back() *= -1.0;
    }
    return surface;
}

bool is_tip(const BlindCorner<2>& corner) { return corner.body == 0 && corner.position.norm() < 1e-12; }

/// A polyhedron around the origin, its faces given by corners in any order of turning.
Surface<3> polyhedron(const std::vector<Vector<3>>& corners, const std::vector<std::vector<int>>& faces) {
    Surface<3> surface;
    for (const std::vector<int>& face : faces) {
        std::vector<Vector<3>> polygon;
        for (const int corner : face) polygon.push_back(corners[corner]);
        if ((polygon[1] - polygon[0]).cross(polygon[2] - polygon[0]).dot(polygon[0]) < 0.0)
            std::reverse(polygon.begin(), polygon.end());
        surface.append(polygon, 0.1, 1.0, 0);
    }
    return surface;
}

Surface<3> tetrahedron() {
    return polyhedron({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}});
}

Surface<3> cube(const Vector<3>& stretch = Vector<3>::Ones()) {
    std::vector<Vector<3>> corners;
    for (int i = 0; i < 8; ++i)
        corners.push_back(stretch.cwiseProduct(Vector<3>(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
    return polyhedron(corners, {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}});
}

}  // namespace

TEST_CASE("a tip in the plane is blind up to the angle 180 degrees - 2 acos(-facing_cosine)", "[contact][blind]") {
    const double facing_cosine = GENERATE(-0.5, -0.3, -0.02);
    const double limit = pi - 2.0 * std::acos(-facing_cosine);
    const double turn = GENERATE(0.0, 0.4, 2.0);
    for (const double factor : {0.2, 0.999, 1.001, 1.5}) {
        CAPTURE(facing_cosine, turn, factor);
        const auto surface = wedge(factor * limit, turn);
        const auto blind = blind_corners<2>(surface.view(), facing_cosine);
        CHECK(std::ranges::any_of(blind, is_tip) == (factor < 1.0));
    }
}

TEST_CASE("corners of a brick are seen by default, and blind where 1/sqrt(3) does not count as facing", "[contact][blind]") {
    const auto brick = cube({1.0, 0.1, 5.0});
    CHECK(blind_corners<3>(brick.view(), -0.5).empty());
    CHECK(blind_corners<3>(brick.view(), -1.0 / std::sqrt(3.0) + 1e-6).empty());
    CHECK(blind_corners<3>(brick.view(), -1.0 / std::sqrt(3.0) - 1e-6).size() == 8);
}

// Around a corner of a regular tetrahedron the three normals make an angle with the axis whose cosine is 1/3.
TEST_CASE("corners of a regular tetrahedron are blind where a cosine of 1/3 does not count as facing", "[contact][blind]") {
    const auto surface = tetrahedron();
    CHECK(blind_corners<3>(surface.view(), -0.5).size() == 4);
    CHECK(blind_corners<3>(surface.view(), -1.0 / 3.0 - 1e-6).size() == 4);
    CHECK(blind_corners<3>(surface.view(), -1.0 / 3.0 + 1e-6).empty());
}

TEST_CASE("a notch is no tip: nothing can come straight at its bottom", "[contact][blind]") {
    auto surface = wedge(0.3, 0.0);
    for (auto& normal : surface.normal) normal *= -1.0;  // the outside becomes the inside
    const auto blind = blind_corners<2>(surface.view(), -0.5);
    CHECK(std::ranges::none_of(blind, is_tip));
}
