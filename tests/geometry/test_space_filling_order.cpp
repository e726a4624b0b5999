#include <catch2/catch.hpp>
#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "abut/geometry/space_filling_order.hpp"

using namespace abut;
using geometry::space_filling_order;

namespace {

template <int Dim>
std::vector<Vector<Dim>> random_points(int count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    std::vector<Vector<Dim>> points(count);
    for (Vector<Dim>& point : points)
        for (double& x : point) x = number(random);
    return points;
}

template <int Dim>
double path_length(const std::vector<Vector<Dim>>& points, const std::vector<std::int32_t>& order) {
    double length = 0.0;
    for (std::size_t k = 1; k < order.size(); ++k) length += (points[order[k]] - points[order[k - 1]]).norm();
    return length;
}

std::vector<std::int32_t> identity(std::size_t count) {
    std::vector<std::int32_t> order(count);
    std::iota(order.begin(), order.end(), 0);
    return order;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the order visits every point once and goes to near points next", "[space_filling_order]", ((int Dim), Dim), 2, 3) {
    const auto points = random_points<Dim>(10000);
    std::vector<std::int32_t> order = space_filling_order<Dim>(points);
    // A shortest path through n random points has a length of about n^(1 - 1/Dim); a Hilbert curve is within a factor of 2.
    CHECK(path_length<Dim>(points, order) < 2.0 * std::pow(10000.0, 1.0 - 1.0 / Dim));
    CHECK(path_length<Dim>(points, order) < 0.1 * path_length<Dim>(points, identity(points.size())));
    std::sort(order.begin(), order.end());
    CHECK((order == identity(points.size())));
}

TEST_CASE("the same points give the same order", "[space_filling_order]") {
    const auto points = random_points<3>(5000);
    CHECK((space_filling_order<3>(points) == space_filling_order<3>(points)));
}

TEST_CASE("no points, one point, many coinciding points", "[space_filling_order]") {
    CHECK(space_filling_order<3>({}).empty());
    CHECK((space_filling_order<2>(std::vector<Vector<2>>{{1, 2}}) == std::vector<std::int32_t>{0}));
    std::vector<std::int32_t> order = space_filling_order<3>(std::vector<Vector<3>>(1000, Vector<3>(1, 2, 3)));
    std::sort(order.begin(), order.end());
    CHECK((order == identity(1000)));
}

TEST_CASE("a coordinate that is not finite is an error that names the point", "[space_filling_order][errors]") {
    std::vector<Vector<2>> points(5, Vector<2>::Zero());
    points[3].y() = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(space_filling_order<2>(points), Catch::Matchers::Contains("point 3"));
}
