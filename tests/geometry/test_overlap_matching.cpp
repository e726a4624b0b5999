// Meshes that match except for rounding, as conforming interfaces give them: whether two triangles overlap hangs on last
// digits, and the digits decide.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "triangle_pairs.hpp"

using namespace abut;
using namespace abut::test;

namespace {

using Triangles = std::vector<Corners>;

struct Patch {
    double jitter;  ///< of the corners, over the cells' size; without it edges of neighbours lie on one line
    double turn;    ///< [rad]
    Point offset;
    int parts;  ///< each triangle is cut into the square of this
};

Point rotated(const Point& p, double turn) {
    return {std::cos(turn) * p.x() - std::sin(turn) * p.y(), std::sin(turn) * p.x() + std::cos(turn) * p.y()};
}

/// Cuts a triangle into parts^2 by lines parallel to its edges.
void append_parts(const Corners& whole, int parts, Triangles& triangles) {
    const auto point = [&](int i, int j) {
        return Point(whole[0] + (static_cast<double>(i) / parts) * (whole[1] - whole[0]) +
                     (static_cast<double>(j) / parts) * (whole[2] - whole[0]));
    };
    for (int i = 0; i < parts; ++i)
        for (int j = 0; i + j < parts; ++j) {
            triangles.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
            if (i + j + 1 < parts) triangles.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
        }
}

Triangles make(const Patch& patch, unsigned seed) {
    constexpr int n = 3;
    std::mt19937 random(seed);
    std::array<std::array<Point, n + 1>, n + 1> points;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            points[i][j] =
                patch.offset +
                rotated(Point(i + patch.jitter * uniform(random, -1, 1), j + patch.jitter * uniform(random, -1, 1)) / n,
                        patch.turn);
    Triangles triangles;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            append_parts({points[i][j], points[i + 1][j], points[i + 1][j + 1]}, patch.parts, triangles);
            append_parts({points[i][j], points[i + 1][j + 1], points[i][j + 1]}, patch.parts, triangles);
        }
    return triangles;
}

/// Moves each coordinate by up to so many last digits.
void disturb(Triangles& triangles, int digits, std::mt19937& random) {
    std::uniform_int_distribution<int> moves(-digits, digits);
    for (Corners& triangle : triangles)
        for (Point& corner : triangle)
            for (int d = 0; d < 2; ++d) {
                const int n = moves(random);
                for (int k = 0; k < std::abs(n); ++k) corner[d] = std::nextafter(corner[d], n > 0 ? 1e300 : -1e300);
            }
}

std::vector<TrianglePair> all_pairs(const Triangles& of_1, const Triangles& of_2) {
    std::vector<TrianglePair> pairs;
    for (const Corners& face_1 : of_1)
        for (std::size_t k = 0; k < of_2.size(); ++k)
            pairs.push_back({face_1, {of_2[k][k % 3], of_2[k][(k + 1) % 3], of_2[k][(k + 2) % 3]}, Point::Zero()});
    return pairs;
}

std::vector<TrianglePair> disturbed_pairs(const Patch& patch, int digits, unsigned seed, int parts_of_other) {
    Patch other = patch;
    other.parts = parts_of_other;
    Triangles triangles = make(other, seed);
    std::mt19937 random(seed);
    disturb(triangles, digits, random);
    return all_pairs(make(patch, seed), triangles);
}

/// Many at once against one by one.
double largest_difference_of_derivatives(const std::vector<TrianglePair>& pairs, const Batch& batch) {
    double largest = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k)
        largest = std::max(largest, (batch.areas[k].area_gradient - alone(pairs[k]).area_gradient).norm());
    return largest;
}

}  // namespace

TEST_CASE("on meshes that match except for rounding decisions are those of exact arithmetic", "[overlap][batch][matching]") {
    const double jitter = GENERATE(0.0, 0.2);
    const int digits = GENERATE(0, 1, 2, 5000);
    const double far = GENERATE(0.0, 1.0, 1e3, 1e6);
    CAPTURE(jitter, digits, far);
    for (unsigned seed = 0; seed < 3; ++seed) {
        const double turn = seed == 0 ? 0.0 : 0.7 * seed + 0.1 * digits;
        check_against_exact(disturbed_pairs({jitter, turn, far * Point(0.6, -0.8), 1}, digits, seed, 1));
    }
}

TEST_CASE("corners of a finer mesh that lie on edges except for rounding are on the side that exact arithmetic says",
          "[overlap][batch][matching]") {
    const int parts = GENERATE(2, 3), digits = GENERATE(0, 1);
    const double far = GENERATE(0.0, 1e3);
    CAPTURE(parts, digits, far);
    for (unsigned seed = 1; seed < 3; ++seed)
        check_against_exact(disturbed_pairs({0.2, 0.7 * seed, far * Point(0.6, -0.8), 1}, digits, seed, parts));
}

TEST_CASE("meshes that match except for rounding are decided many at once", "[overlap][batch][matching]") {
    const double jitter = GENERATE(0.0, 0.2), far = GENERATE(1.0, 10.0);
    const int digits = GENERATE(0, 1, 2);
    CAPTURE(jitter, far, digits);
    DecisionCounts counts;
    for (unsigned seed = 0; seed < 20; ++seed)
        counts += many(disturbed_pairs({jitter, 0.1 + 0.3 * seed, far * Point(0.6, -0.8), 1}, digits, seed, 1)).counts;
    CHECK(static_cast<double>(counts.by_doubles) > 0.99 * static_cast<double>(counts.total()));
}

TEST_CASE("edges that coincide except for rounding count half in the derivative, many at once as one by one",
          "[overlap][batch][matching]") {
    const int digits = GENERATE(1, 2), parts = GENERATE(1, 2);
    const double far = GENERATE(0.0, 1.0, 100.0);
    CAPTURE(digits, parts, far);
    for (unsigned seed = 0; seed < 10; ++seed) {
        const auto pairs = disturbed_pairs({0.2, 0.3 * seed, far * Point(0.6, -0.8), 1}, digits, seed, parts);
        CHECK(largest_difference_of_derivatives(pairs, many(pairs)) < 1e-11);
    }
}

TEST_CASE("a triangle on itself, disturbed by last digits, shares no more when it is moved", "[overlap][batch][matching]") {
    const int digits = GENERATE(1, 2);
    const Triangles triangles = make({0.2, 0.7, {0.6, -0.8}, 1}, 5);
    Triangles disturbed = triangles;
    std::mt19937 random(5);
    disturb(disturbed, digits, random);
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const OverlapArea<3> shared = many({{triangles[k], disturbed[k], Point::Zero()}}).areas[0];
        CHECK(shared.area == Approx(0.5 * twice_area(triangles[k])).epsilon(1e-14));
        CHECK(shared.area_gradient.norm() < 1e-14);  // the mean of losing and of gaining
    }
}
