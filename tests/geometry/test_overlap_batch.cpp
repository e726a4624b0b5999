#include <catch2/catch.hpp>
#include <cstring>

#include "triangle_pairs.hpp"

using namespace abut;
using namespace abut::test;

namespace {

Corners counter_clockwise(Corners corners) {
    if (twice_area(corners) < 0.0) std::swap(corners[1], corners[2]);
    return corners;
}

Corners random_triangle(std::mt19937& random, double size, const Point& centre) {
    const Polygon polygon = random_polygon(random, 3, centre, size);
    return {polygon[0], polygon[1], polygon[2]};
}

// Corners on a grid of n x n points with the spacing h: most pairs are degenerate in some way.
Corners grid_triangle(std::mt19937& random, int n, double h) {
    std::uniform_int_distribution<int> index(0, n - 1);
    Corners corners;
    do
        for (Point& corner : corners) corner = Point(index(random), index(random));
    while (twice_area(corners) == 0.0);
    corners = counter_clockwise(corners);
    for (Point& corner : corners) corner *= h;
    return corners;
}

bool same_bits(const OverlapArea<3>& a, const OverlapArea<3>& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

// Pairs of all kinds: apart, overlapping, with common corners and edges, shifted, almost coinciding.
std::vector<TrianglePair> mixed_pairs(int n) {
    std::mt19937 random(11);
    std::vector<TrianglePair> pairs;
    for (int k = 0; k < n; ++k) {
        TrianglePair pair{grid_triangle(random, 4, 0.25), grid_triangle(random, 4, 0.25), Point::Zero()};
        if (k % 3 == 0) pair.face_2 = random_triangle(random, uniform(random, 0.1, 2), {0, 0});
        if (k % 5 == 0) pair.shift = {uniform(random, -1, 1), uniform(random, -1, 1)};
        if (k % 7 == 0) pair.face_2[k % 3] *= 1.0 + epsilon;
        pairs.push_back(pair);
    }
    return pairs;
}

}  // namespace

TEST_CASE("many triangles at once share what one by one they share", "[overlap][batch]") {
    std::mt19937 random(1);
    std::vector<TrianglePair> pairs;
    for (int k = 0; k < 20000; ++k)
        pairs.push_back({random_triangle(random, 1.0, {0, 0}),
                         random_triangle(random, 0.8, {0.1, 0.2}),
                         {uniform(random, -1, 1), uniform(random, -1, 1)}});
    const Batch batch = many(pairs);
    CHECK(batch.counts.by_doubles == 20000);  // in general position
    double area = 0.0, derivative = 0.0;
    int overlapping = 0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const OverlapArea<3> one = alone(pairs[k]);
        CHECK((one.area > 0.0) == (batch.areas[k].area > 0.0));
        overlapping += one.area > 0.0;
        area = std::max(area, std::abs(one.area - batch.areas[k].area));
        derivative = std::max(derivative, (one.area_gradient - batch.areas[k].area_gradient).norm());
    }
    CHECK(overlapping > 5000);
    CHECK(area < 2e-15);
    CHECK(derivative < 1e-11);  // the crossing of lines at a small angle
}

TEST_CASE("areas and decisions are those of exact arithmetic", "[overlap][batch]") {
    std::mt19937 random(2);
    const double h = GENERATE(1.0, 0.1, 1.0 / 3.0, 0x1p-30, 1e-9, 1e9, 1e-160, 1e60);
    const int n = GENERATE(2, 3, 5, 9);
    CAPTURE(h, n);
    std::vector<TrianglePair> on_grid, nearly, shifted;
    for (int k = 0; k < 400; ++k) {
        const TrianglePair pair{grid_triangle(random, n, h), grid_triangle(random, n, h), Point::Zero()};
        on_grid.push_back(pair);
        nearly.push_back(pair);
        for (int i = 0; i < 3; ++i) {
            if (k % 2 == 0) nearly.back().face_1[i] *= 1.0 + epsilon * std::uniform_int_distribution<int>(-2, 2)(random);
            nearly.back().face_2[i].x() *= 1.0 + epsilon * std::uniform_int_distribution<int>(-2, 2)(random);
        }
        shifted.push_back(pair);
        shifted.back().shift = h * Point(uniform(random, -1, 1), k % 2);
        for (Point& corner : shifted.back().face_2) corner -= shifted.back().shift;
    }
    check_against_exact(on_grid);
    check_against_exact(nearly);
    check_against_exact(shifted);
}

TEST_CASE("coinciding edges count half in the derivative, as exact arithmetic has it", "[overlap][batch]") {
    std::mt19937 random(3);
    std::vector<TrianglePair> pairs;
    for (int k = 0; k < 5000; ++k) pairs.push_back({grid_triangle(random, 4, 0.5), grid_triangle(random, 4, 0.5), {0, 0}});
    const Batch batch = many(pairs);
    CHECK(batch.counts.by_doubles > 1000);
    double largest = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k)
        largest =
            std::max(largest, (batch.areas[k].area_gradient - alone(pairs[k], AreaMethod::exact).area_gradient).norm());
    CHECK(largest < 1e-14);
}

TEST_CASE("a triangle on itself, and its neighbours over an edge and over a corner, are decided by doubles",
          "[overlap][batch]") {
    const double scale = GENERATE(1.0, 1e-9, 1e9), turn = GENERATE(0.0, 0.3, 1.0);
    // Five triangles about a point, as of a mesh that matches.
    std::vector<Corners> fan;
    const auto rim = [&](int i) {
        return Point(scale *
                     Point(std::cos(turn + i * 0.4 * std::numbers::pi), std::sin(turn + i * 0.4 * std::numbers::pi)));
    };
    const std::array<Point, 5> corners{rim(0), rim(1), rim(2), rim(3), rim(4)};
    for (int i = 0; i < 5; ++i) fan.push_back({Point::Zero(), corners[i], corners[(i + 1) % 5]});
    std::vector<TrianglePair> pairs;
    for (const Corners& face_1 : fan)
        for (const Corners& face_2 : fan) pairs.push_back({face_1, {face_2[1], face_2[2], face_2[0]}, Point::Zero()});
    const Batch batch = many(pairs);
    CHECK(batch.counts.by_doubles == 25);
    for (int k = 0; k < 25; ++k) {
        const bool is_itself = k % 6 == 0;
        CHECK(batch.areas[k].area == Approx(is_itself ? 0.5 * twice_area(fan[k / 5]) : 0.0).epsilon(1e-15));
        CHECK(batch.areas[k].area_gradient.norm() < 1e-15 * scale);
    }
}

TEST_CASE("the areas of the parts of a triangle add up, whatever is cut with them", "[overlap][batch]") {
    std::mt19937 random(4);
    std::vector<TrianglePair> wholes, parts;
    for (int k = 0; k < 3000; ++k) {
        const Corners face_1 = random_triangle(random, std::pow(10.0, uniform(random, -2, 2)), {0, 0}),
                      face_2 = random_triangle(random, 1.0, {uniform(random, -1, 1), uniform(random, -1, 1)});
        const Point inner = 0.5 * face_2[0] + 0.2 * face_2[1] + 0.3 * face_2[2];
        wholes.push_back({face_1, face_2, Point::Zero()});
        for (int i = 0; i < 3; ++i) parts.push_back({face_1, {face_2[i], face_2[(i + 1) % 3], inner}, Point::Zero()});
    }
    const Batch whole = many(wholes), part = many(parts);
    double largest = 0.0;
    for (std::size_t k = 0; k < wholes.size(); ++k) {
        const double sum = part.areas[3 * k].area + part.areas[3 * k + 1].area + part.areas[3 * k + 2].area;
        const double size = std::max(1.0, std::sqrt(twice_area(wholes[k].face_1)));
        largest = std::max(largest, std::abs(sum - whole.areas[k].area) / size);
    }
    CHECK(largest < 4e-15);
}

TEST_CASE("a much larger partner costs no more digits than its coordinates have", "[overlap][batch]") {
    // Rounding moves an edge of a by eps |a|, and that times the size of b is the area it may sweep over b.
    std::mt19937 random(5);
    const double ratio = GENERATE(1.0, 1e2, 1e4);
    std::vector<TrianglePair> pairs;
    for (int k = 0; k < 500; ++k) {
        TrianglePair pair{random_triangle(random, 1.0, {0, 0}), random_triangle(random, ratio, {0, 0}), Point::Zero()};
        const Point& corner = pair.face_2[k % 3];
        pair.shift = uniform(random, 0, 1) * Point(pair.face_2[(k + 1) % 3] - corner) - corner;
        if (k % 2 == 0) pair = {pair.face_2, pair.face_1, -pair.shift};
        if (k % 3 == 0)  // as exact as can be: no shift is added
            for (Point& point : pair.face_2) point += pair.shift;
        if (k % 3 == 0) pair.shift.setZero();
        pairs.push_back(pair);
    }
    const Batch batch = many(pairs);
    for (std::size_t k = 0; k < pairs.size(); ++k)
        CHECK(std::abs(batch.areas[k].area - alone(pairs[k], AreaMethod::exact).area) < 10 * epsilon * ratio);
}

TEST_CASE("swapped faces share the same, with the derivative reversed", "[overlap][batch]") {
    std::vector<TrianglePair> pairs = mixed_pairs(5000), swapped;
    for (const TrianglePair& pair : pairs) swapped.push_back({pair.face_2, pair.face_1, -pair.shift});
    const Batch one = many(pairs), other = many(swapped);
    double area = 0.0, derivative = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        CHECK((one.areas[k].area > 0.0) == (other.areas[k].area > 0.0));
        area = std::max(area, std::abs(one.areas[k].area - other.areas[k].area));
        if (one.areas[k].area > 1e-12)
            derivative = std::max(derivative, (one.areas[k].area_gradient + other.areas[k].area_gradient).norm());
    }
    CHECK(area < 2e-15);
    CHECK(derivative < 1e-10);
}

TEST_CASE("the derivative is that of central differences in general position, also of many at once", "[overlap][batch]") {
    std::mt19937 random(6);
    constexpr double step = 0x1p-14;
    int tested = 0;
    for (int k = 0; k < 2000; ++k) {
        const TrianglePair pair{random_triangle(random, 1.0, {0, 0}),
                                random_triangle(random, 0.8, {0.3, 0.1}),
                                {uniform(random, -1, 1), uniform(random, -1, 1)}};
        std::vector<double> events;
        std::vector<TrianglePair> pairs{pair};
        for (int axis = 0; axis < 2; ++axis) {
            const Point delta = step * Point::Unit(axis);
            geometry::append_overlap_events<3>(pair.face_1, pair.face_2, pair.shift - delta, pair.shift + delta, events);
            for (const double way : {-1.0, 1.0}) pairs.push_back({pair.face_1, pair.face_2, pair.shift + way * delta});
        }
        if (!events.empty()) continue;  // between events the area is quadratic and the difference exact
        const Batch batch = many(pairs);
        const Point expected(batch.areas[2].area - batch.areas[1].area, batch.areas[4].area - batch.areas[3].area);
        CHECK((batch.areas[0].area_gradient - expected / (2 * step)).norm() < 1e-10);
        ++tested;
    }
    CHECK(tested > 1500);
}

TEST_CASE("a pair gives the same bits wherever it stands and whoever stands beside it", "[overlap][batch]") {
    const std::vector<TrianglePair> pairs = mixed_pairs(999);
    const Batch all = many(pairs);
    for (std::size_t first = 0; first < pairs.size(); ++first) {
        const Batch one = many({pairs[first]});
        CHECK(same_bits(one.areas[0], all.areas[first]));
    }
    std::vector<TrianglePair> reversed(pairs.rbegin(), pairs.rend());
    const Batch back = many(reversed);
    for (std::size_t k = 0; k < pairs.size(); ++k) CHECK(same_bits(back.areas[pairs.size() - 1 - k], all.areas[k]));
    CHECK(all.counts.by_doubles == back.counts.by_doubles);
    CHECK(all.counts.by_scalar_path == back.counts.by_scalar_path);
    CHECK(all.counts.by_exact_arithmetic == back.counts.by_exact_arithmetic);
    CHECK(all.counts.by_scalar_path + all.counts.by_exact_arithmetic > 50);  // every way is in the sample
}

TEST_CASE("special positions of triangles share the area of elementary geometry when many are cut at once",
          "[overlap][batch]") {
    std::vector<TrianglePair> pairs;
    std::vector<double> expected, limits;
    std::vector<std::string> names;
    for (const NamedPair& pair : special_positions())
        for (const Placement& place : placements()) {
            if (pair.face_1.size() != 3 || pair.face_2.size() != 3) continue;
            const Polygon f_1 = placed(pair.face_1, place.scale, place.offset),
                          f_2 = placed(pair.face_2, place.scale, place.offset);
            pairs.push_back({{f_1[0], f_1[1], f_1[2]}, {f_2[0], f_2[1], f_2[2]}, Point::Zero()});
            expected.push_back(place.scale * place.scale * pair.area);
            limits.push_back(4 * epsilon * place.scale * (place.offset.cwiseAbs().maxCoeff() + place.scale));
            names.push_back(pair.name);
        }
    const Batch batch = many(pairs);
    REQUIRE(pairs.size() > 30);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        CAPTURE(names[k]);
        CHECK(std::abs(batch.areas[k].area - expected[k]) <= limits[k]);
        if (expected[k] == 0.0 && limits[k] < 1e-4) CHECK(batch.areas[k].area <= limits[k]);
    }
}

TEST_CASE("numbers of pairs and of areas that differ are refused", "[overlap][batch][errors]") {
    std::vector<TrianglePair> pairs(3);
    std::vector<OverlapArea<3>> areas(2);
    CHECK_THROWS_WITH(geometry::overlap_areas(pairs, areas),
                      "shared areas: `areas` has 2 entries for 3 pairs. Give as many.");
    CHECK(geometry::overlap_areas({}, {}).total() == 0);
}
