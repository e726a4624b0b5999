#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "abut/base/rotation.hpp"
#include "abut/geometry/plane_frame.hpp"
#include "abut/geometry/polygon.hpp"

using namespace abut;
using namespace abut::geometry;

namespace {

using Face = std::vector<Vector<3>>;

Face turned(const Face& face, const Vector<3>& by) {
    const Matrix<3> turn = rotation_about(Vector<3>(1, 2, 3).normalized(), 1.1);
    Face result;
    for (const Vector<3>& vertex : face) result.push_back(turn * vertex + by);
    return result;
}
Vector<3> turned_axis(const Vector<3>& axis) { return turned({axis}, Vector<3>::Zero())[0]; }

Face regular(int n) {
    Face face;
    for (int i = 0; i < n; ++i)
        face.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n), 0.0);
    return face;
}

}  // namespace

TEST_CASE("measure, centroid and normal of polygons are those of elementary geometry", "[polygon]") {
    const Vector<3> by(3, -2, 5);
    const Face triangle = turned({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, by);
    CHECK(face_measure<3>(triangle) == Approx(6.0).epsilon(1e-14));
    CHECK((face_centroid<3>(triangle) - turned({{1, 4.0 / 3.0, 0}}, by)[0]).norm() < 1e-14);
    CHECK((face_normal<3>(triangle) - turned_axis({0, 0, 1})).norm() < 1e-14);
    // A trapezium: parallel sides 3 and 1, height 2; centroid at height (h/3)(a + 2b)/(a + b).
    const Face trapezium = turned({{0, 0, 0}, {3, 0, 0}, {2, 2, 0}, {1, 2, 0}}, by);
    CHECK(face_measure<3>(trapezium) == Approx(4.0).epsilon(1e-14));
    CHECK((face_centroid<3>(trapezium) - turned({{1.5, 2.0 / 3.0 * 5.0 / 4.0, 0}}, by)[0]).norm() < 1e-14);
    for (const int n : {3, 4, 5, 16})
        CHECK(face_measure<3>(regular(n)) == Approx(0.5 * n * std::sin(2 * std::numbers::pi / n)).epsilon(1e-14));
}

TEST_CASE("reversing the vertices reverses the normal and nothing else", "[polygon]") {
    const Face face = turned(regular(5), {1, 1, 1}), reversed(face.rbegin(), face.rend());
    CHECK((face_normal<3>(face) + face_normal<3>(reversed)).norm() < 1e-14);
    CHECK((face_centroid<3>(face) - face_centroid<3>(reversed)).norm() < 1e-14);
    CHECK(face_measure<3>(face) == Approx(face_measure<3>(reversed)).epsilon(1e-14));
}

TEST_CASE("a distant origin costs no digits beyond those of the vertices", "[polygon]") {
    Face face = regular(6);
    const Vector<3> far(0x1p23, -0x1p23, 0x1p23);
    for (Vector<3>& vertex : face)
        vertex = 0x1p-10 * vertex.unaryExpr([](double x) { return std::round(0x1p19 * x) * 0x1p-19; }) + far;
    const Face near = [&] {
        Face copy = face;
        for (Vector<3>& vertex : copy) vertex -= far;
        return copy;
    }();
    CHECK(face_measure<3>(face) == Approx(face_measure<3>(near)).epsilon(1e-14));
    CHECK((face_normal<3>(face) - face_normal<3>(near)).norm() < 1e-14);
}

TEST_CASE("2D: a counter-clockwise boundary has outward normals", "[polygon][2d]") {
    const std::vector<Vector<2>> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    for (int i = 0; i < 4; ++i) {
        const std::vector<Vector<2>> face = {square[i], square[(i + 1) % 4]};
        CHECK(face_measure<2>(face) == 2.0);
        CHECK(face_normal<2>(face).dot(face_centroid<2>(face) - Vector<2>(1, 1)) == 1.0);
        CHECK(planarity_deviation<2>(face) == 0.0);
        CHECK(is_convex<2>(face, 0.0));
    }
}

TEST_CASE("a lifted corner is measured as deviation from the plane", "[polygon]") {
    // Opposite corners of a square up by d, the others down by d: the plane stays, each corner is off by d.
    const double d = 1e-3;
    const Face warped = turned({{0, 0, d}, {1, 0, -d}, {1, 1, d}, {0, 1, -d}}, {4, 4, 4});
    CHECK(planarity_deviation<3>(warped) == Approx(d).epsilon(1e-3));
    CHECK(planarity_deviation<3>(turned(regular(16), {1, 2, 3})) < 1e-14);
    CHECK(planarity_deviation<3>(turned({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {1, 2, 3})) < 1e-14);
}

TEST_CASE("convex: regular, straight corners, repeated vertices. Not convex: a dart, a star", "[polygon]") {
    CHECK(is_convex<3>(turned(regular(16), {1, 2, 3}), 1e-14));
    CHECK(is_convex<3>(Face{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}}, 0.0));
    CHECK(is_convex<3>(Face{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 2, 0}}, 0.0));
    const Face dart = turned({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}}, {1, 2, 3});
    CHECK_FALSE(is_convex<3>(dart, 1e-9));
    Face star;
    for (int i = 0; i < 5; ++i) star.push_back(regular(5)[(2 * i) % 5]);
    CHECK_FALSE(is_convex<3>(star, 1e-9));
}

TEST_CASE("a dent below the tolerance is convex, above it is not", "[polygon]") {
    const Face dented = {{0, 0, 0}, {0.5, 1e-6, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    CHECK(is_convex<3>(dented, 1e-5));
    CHECK_FALSE(is_convex<3>(dented, 1e-7));
}

TEST_CASE("degenerate faces have no measure, no normal and a finite centroid", "[polygon]") {
    const Face line = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    CHECK(face_measure<3>(line) == 0.0);
    CHECK(face_normal<3>(line).isZero(0.0));
    CHECK((face_centroid<3>(line) - Vector<3>(1, 0, 0)).norm() < 1e-15);
    CHECK(is_convex<3>(line, 0.0));
    CHECK(face_normal<2>(std::vector<Vector<2>>(2, Vector<2>(1, 1))).isZero(0.0));
}

TEST_CASE("a plane frame is orthonormal and right-handed for every normal", "[plane_frame]") {
    for (const Vector<3>& direction : {Vector<3>(0, 0, 1), Vector<3>(0, 0, -1), Vector<3>(1, 0, 0), Vector<3>(0, -1, 0),
                                       Vector<3>(1, 1, 1), Vector<3>(1e-9, 1, -1e-9), Vector<3>(-0.3, 0.2, 0.9)}) {
        const PlaneFrame<3> frame(direction.normalized());
        const Vector<3> t0 = frame.tangents().col(0), t1 = frame.tangents().col(1);
        CHECK((t0.cross(t1) - frame.normal()).norm() < 1e-15);
        CHECK(std::abs(t0.norm() - 1.0) + std::abs(t1.norm() - 1.0) + std::abs(t0.dot(t1)) < 1e-15);
    }
}

TEST_CASE("a face is counter-clockwise in the frame of its own normal", "[plane_frame]") {
    const Face face = turned({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {1, 2, 3});
    const PlaneFrame<3> frame(face_normal<3>(face));
    const PlaneVector<3> a = frame.project(face[1] - face[0]), b = frame.project(face[2] - face[0]);
    CHECK(0.5 * (a.x() * b.y() - a.y() * b.x()) == Approx(6.0).epsilon(1e-14));
    CHECK((frame.lift(a) - (face[1] - face[0])).norm() < 1e-14);

    const std::vector<Vector<2>> edge = {{1, 2}, {4, 6}};
    const PlaneFrame<2> line(face_normal<2>(edge));
    CHECK(line.project(edge[1]).x() - line.project(edge[0]).x() == Approx(5.0).epsilon(1e-14));
}
