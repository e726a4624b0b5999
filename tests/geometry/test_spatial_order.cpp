#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "abut/geometry/broad_phase/spatial_order.hpp"

using namespace abut;
using geometry::spatial_order;

namespace {

template <int Dim>
std::vector<Vector<Dim>> random_points(int n) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    std::vector<Vector<Dim>> points(static_cast<std::size_t>(n));
    for (auto& point : points)
        for (double& x : point) x = number(random);
    return points;
}

/// Length of the way through all points.
template <int Dim>
double way(const std::vector<Vector<Dim>>& points, const std::vector<std::int32_t>& order) {
    double length = 0.0;
    for (std::size_t i = 1; i < order.size(); ++i) length += (points[order[i]] - points[order[i - 1]]).norm();
    return length;
}

bool is_permutation(std::vector<std::int32_t> order) {
    std::sort(order.begin(), order.end());
    for (std::size_t i = 0; i < order.size(); ++i)
        if (order[i] != static_cast<std::int32_t>(i)) return false;
    return true;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("every point comes once, and neighbours in the order are near", "[spatial_order]", ((int Dim), Dim),
                       2, 3) {
    // A curve that visits cell after cell of a grid makes n steps of about the spacing n^(-1/Dim), here up to three times
    // that; points in random order are 0.5 or more apart on average.
    const int n = 20000;
    const auto points = random_points<Dim>(n);
    const auto order = spatial_order<Dim>(points);
    REQUIRE(order.size() == points.size());
    CHECK(is_permutation(order));
    CHECK(way<Dim>(points, order) < 3.0 * std::pow(n, 1.0 - 1.0 / Dim));
}

TEST_CASE("points far closer than the cells of the curve are in order too", "[spatial_order]") {
    // Clusters of one shape, each 1e6 times smaller than the one before, the last of them 1e-18 of the whole.
    const int n = 3000;
    const auto shape = random_points<3>(n);
    std::vector<Vector<3>> points;
    for (const double size : {1.0, 1e-6, 1e-12, 1e-18})
        for (const Vector<3>& point : shape) points.push_back(size * point);
    const auto order = spatial_order<3>(points);
    CHECK(is_permutation(order));
    std::vector<std::int32_t> smallest;
    for (const std::int32_t i : order)
        if (i >= 3 * n) smallest.push_back(i);
    CHECK(way<3>(points, smallest) < 1e-18 * 3.0 * std::pow(n, 2.0 / 3.0));
}

TEST_CASE("points at one place, on a line and at the ends of the range of doubles", "[spatial_order]") {
    std::vector<std::int32_t> as_given(100);
    std::iota(as_given.begin(), as_given.end(), 0);
    CHECK(spatial_order<3>(std::vector<Vector<3>>(100, Vector<3>(1, 2, 3))) == as_given);
    CHECK(spatial_order<2>(std::vector<Vector<2>>{}).empty());

    const double largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::denorm_min();
    for (const double scale : {1.0, 1e-9, 1e9, largest / 100, smallest}) {
        std::vector<Vector<3>> line;
        for (int i = 99; i >= 0; --i) line.push_back(Vector<3>(0, scale * i, 0));
        const auto order = spatial_order<3>(line);
        CAPTURE(scale);
        CHECK(is_permutation(order));
        if (scale != smallest) CHECK(std::is_sorted(order.rbegin(), order.rend()));
    }
    CHECK(spatial_order<2>(std::vector<Vector<2>>{{largest, 0}, {-largest, 0}}) == std::vector<std::int32_t>{1, 0});
}

TEST_CASE("a coordinate that is not finite is an error that names the point", "[spatial_order][errors]") {
    auto points = random_points<3>(10);
    points[7].y() = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
    CHECK_THROWS_WITH(spatial_order<3>(points), Catch::Matchers::Contains("point 7"));
}
