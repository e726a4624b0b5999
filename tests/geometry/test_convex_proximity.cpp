#include <ccd/vec3.h>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/geometry/convex_distance.hpp"
#include "abut/geometry/convex_proximity.hpp"

using namespace abut;
using geometry::convex_proximity;
using geometry::ConvexProximity;

namespace {

using Points = std::vector<Vector<3>>;

Points cube(const Vector<3>& lower, double side) {
    Points points;
    for (int corner = 0; corner < 8; ++corner)
        points.push_back(lower + side * Vector<3>(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1));
    return points;
}

Points moved(const Points& points, const Matrix<3>& turn, const Vector<3>& by) {
    Points result;
    for (const Vector<3>& point : points) result.push_back(turn * point + by);
    return result;
}

Matrix<3> random_turn(std::mt19937& random) {
    std::normal_distribution<double> number;
    return Eigen::Quaterniond(number(random), number(random), number(random), number(random))
        .normalized()
        .toRotationMatrix();
}

ConvexProximity<3> proximity(const Points& body_1, const Points& body_2) { return convex_proximity<3>(body_1, body_2); }

}  // namespace

TEST_CASE("libccd is the double build", "[convex_distance]") {
    const ccd_vec3_t origin = {{0, 0, 0}}, a = {{1.0 + 1e-12, -1, 0}}, b = {{1.0 + 1e-12, 1, 0}};
    ccd_vec3_t nearest;
    CHECK(ccdVec3PointSegmentDist2(&origin, &a, &b, &nearest) == Approx((1.0 + 1e-12) * (1.0 + 1e-12)).epsilon(1e-15));
}

TEST_CASE("cubes face to face, edge to edge, corner to corner have the distance of elementary geometry",
          "[convex_distance]") {
    const double scale = GENERATE(1.0, 1e-9, 1e9);
    const double g = 0.25;
    for (const Vector<3>& gap : {Vector<3>(g, 0, 0), Vector<3>(g, g, 0), Vector<3>(g, g, g), Vector<3>(1e-9, 0, 0)}) {
        CAPTURE(scale, gap.transpose());
        Vector<3> lower = gap;
        for (double& x : lower) x = x > 0.0 ? 1.0 + x : 0.3;
        const ConvexProximity<3> result = proximity(cube(Vector<3>::Zero(), scale), cube(scale * lower, scale));
        CHECK(result.depth == 0.0);
        CHECK(result.distance == Approx(scale * gap.norm()).epsilon(1e-6));
        CHECK((result.direction - gap.normalized()).norm() < 1e-5);
    }
}

TEST_CASE("cubes that interlock by d have the depth d", "[convex_distance]") {
    const double depth = GENERATE(1e-6, 1e-3, 0.1, 0.4);
    std::mt19937 random(1);
    for (int trial = 0; trial < 20; ++trial) {
        const Matrix<3> turn = random_turn(random);
        const Points body_1 = moved(cube(Vector<3>::Zero(), 1.0), turn, {5, 6, 7}),
                     body_2 = moved(cube({1.0 - depth, 0.2, -0.1}, 1.0), turn, {5, 6, 7});
        const ConvexProximity<3> result = proximity(body_1, body_2);
        CAPTURE(depth, trial);
        CHECK(result.distance == 0.0);
        CHECK(result.depth == Approx(depth).epsilon(1e-9).margin(1e-13));
        CHECK((result.direction - turn.col(0)).norm() < 1e-3);
    }
}

TEST_CASE("touching cubes are neither apart nor interlocked", "[convex_distance]") {
    std::mt19937 random(2);
    for (int trial = 0; trial < 50; ++trial) {
        CAPTURE(trial);
        const Matrix<3> turn = trial == 0 ? Matrix<3>::Identity() : random_turn(random);
        for (const Vector<3>& corner :
             {Vector<3>(1, 0, 0), Vector<3>(1, 0.3, 0.4), Vector<3>(1, 1, 0.2), Vector<3>(1, 1, 1)}) {
            const ConvexProximity<3> result =
                proximity(moved(cube(Vector<3>::Zero(), 1.0), turn, {0, 0, 0}), moved(cube(corner, 1.0), turn, {0, 0, 0}));
            CHECK(result.distance < 1e-9);
            CHECK(result.depth < 1e-9);
        }
    }
}

TEST_CASE("moving body 2 by the depth along the direction parts any two bodies, swapping them turns the direction",
          "[convex_distance]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int interlocked = 0;
    for (int trial = 0; trial < 200; ++trial) {
        CAPTURE(trial);
        Points body_1(20), body_2(12);
        for (Vector<3>& p : body_1) p = {number(random), number(random), number(random)};
        for (Vector<3>& p : body_2)
            p = Vector<3>(number(random), number(random), number(random)) + Vector<3>(2.0 * number(random), 1.0, 0.3);
        const ConvexProximity<3> result = proximity(body_1, body_2), swapped = proximity(body_2, body_1);
        CHECK(result.distance == Approx(swapped.distance).margin(1e-6));
        CHECK(result.depth == Approx(swapped.depth).margin(1e-6));
        CHECK(result.direction.norm() == Approx(1.0).epsilon(1e-12));
        if (result.depth == 0.0) continue;
        ++interlocked;
        const Points apart = moved(body_2, Matrix<3>::Identity(), (result.depth + 1e-3) * result.direction);
        CHECK(proximity(body_1, apart).distance == Approx(1e-3).margin(1e-6));
    }
    CHECK(interlocked > 20);
}

TEST_CASE("two tetrahedra whose edges cross have the depth along the common normal of these edges", "[convex_distance]") {
    // Edges along x and y, at heights 0 and -depth, each the top (bottom) of a wedge: no face is as near as the edges are.
    const double depth = GENERATE(1e-3, 0.1, 0.3);
    std::mt19937 random(4);
    for (int trial = 0; trial < 20; ++trial) {
        CAPTURE(depth, trial);
        const Matrix<3> turn = random_turn(random);
        const Points low = {{-1, 0, 0}, {1, 0, 0}, {0, 1, -2}, {0, -1, -2}};
        const Points high = {{0.1, -1, -depth}, {0.1, 1, -depth}, {1.1, 0, 2}, {-0.9, 0, 2}};
        const ConvexProximity<3> result = proximity(moved(low, turn, {1, 2, 3}), moved(high, turn, {1, 2, 3}));
        CHECK(result.depth == Approx(depth).epsilon(1e-11));
        CHECK((result.direction - turn.col(2)).norm() < 1e-11);
    }
}

TEST_CASE("2D: squares and a segment", "[convex_distance][2d]") {
    const std::vector<Vector<2>> square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const auto moved_square = [&](double x, double y) {
        std::vector<Vector<2>> result = square;
        for (Vector<2>& p : result) p += Vector<2>(x, y);
        return result;
    };
    CHECK(convex_proximity<2>(square, moved_square(1.5, 0.2)).distance == Approx(0.5).epsilon(1e-9));
    CHECK(convex_proximity<2>(square, moved_square(2, 2)).distance == Approx(std::sqrt(2.0)).epsilon(1e-9));
    const ConvexProximity<2> interlocked = convex_proximity<2>(square, moved_square(0.3, -0.875));
    CHECK(interlocked.depth == Approx(0.125).epsilon(1e-6));
    CHECK((interlocked.direction - Vector<2>(0, -1)).norm() < 1e-3);
    const ConvexProximity<2> touching = convex_proximity<2>(square, moved_square(1, 0.5));
    CHECK(touching.depth + touching.distance < 1e-9);
    CHECK(convex_proximity<2>(square, std::vector<Vector<2>>{{0.5, 0.75}, {0.5, 3}}).depth == Approx(0.25).epsilon(1e-6));
}

TEST_CASE("single points and coinciding bodies give an answer", "[convex_distance]") {
    const Points point = {{3, 4, 0}}, origin = {{0, 0, 0}};
    CHECK(proximity(origin, point).distance == Approx(5.0).epsilon(1e-12));
    const ConvexProximity<3> same = proximity(point, point);
    CHECK(same.distance == 0.0);
    CHECK(same.depth == 0.0);
    CHECK(proximity(cube({0, 0, 0}, 1), cube({0, 0, 0}, 1)).depth == Approx(1.0).epsilon(1e-6));
}

TEST_CASE("bodies without points and coordinates that are not finite are errors", "[convex_distance][errors]") {
    const Points body = cube({0, 0, 0}, 1.0), bad = {{0, std::numeric_limits<double>::quiet_NaN(), 0}};
    CHECK_THROWS_AS(proximity(body, {}), BadInput);
    CHECK_THROWS_WITH(proximity(body, {}),
                      "convex_proximity: a body has 0 points, at least 1 is needed. Leave the body out.");
    CHECK_THROWS_AS(proximity(bad, body), BadInput);
    CHECK_THROWS_WITH(proximity(bad, body), Catch::Contains("point 0 has the y coordinate nan, a finite number is needed."));
}
