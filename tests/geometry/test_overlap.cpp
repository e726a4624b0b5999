#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "polygons.hpp"

using namespace abut;
using namespace abut::test;
using geometry::overlap_area;

namespace {

constexpr std::array methods{AreaMethod::fast, AreaMethod::exact};

using Segment = std::array<PlaneVector<2>, 2>;

OverlapArea<2> shared_length(const Segment& face_1, const Segment& face_2, double shift, AreaMethod method) {
    return overlap_area<2>(face_1, face_2, PlaneVector<2>(shift), method);
}
Segment segment(double lower, double upper) { return {PlaneVector<2>(lower), PlaneVector<2>(upper)}; }

// Whole cells of a grid of n x n over the unit square, each cut in two triangles.
std::vector<Polygon> triangles_over_unit_square(int n) {
    std::vector<Polygon> triangles;
    const double h = 1.0 / n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Point a(i * h, j * h), b((i + 1) * h, j * h), c((i + 1) * h, (j + 1) * h), d(i * h, (j + 1) * h);
            triangles.push_back({a, b, c});
            triangles.push_back({a, c, d});
        }
    return triangles;
}

Point central_difference(const Polygon& face_1, const Polygon& face_2, const Point& shift, double step) {
    Point result;
    for (int axis = 0; axis < 2; ++axis) {
        const Point delta = step * Point::Unit(axis);
        result[axis] =
            (shared(face_1, face_2, shift + delta).area - shared(face_1, face_2, shift - delta).area) / (2 * step);
    }
    return result;
}

Polygon counter_clockwise(Polygon polygon) {
    if (area_of(polygon) < 0.0) std::reverse(polygon.begin() + 1, polygon.end());
    return polygon;
}

// The answer, which must be the same with the faces swapped.
bool check_same_decision(const Polygon& face_1, const Polygon& face_2, const Point& shift) {
    const OverlapArea<3> fast = shared(face_1, face_2, shift), swapped = shared(face_2, face_1, -shift);
    const OverlapArea<3> exact = shared(face_1, face_2, shift, AreaMethod::exact);
    const double size = std::max(size_of(face_1), size_of(face_2)), largest = std::max(size, shift.cwiseAbs().maxCoeff());
    CHECK((fast.area > 0.0) == (exact.area > 0.0));
    CHECK((swapped.area > 0.0) == (exact.area > 0.0));
    CHECK(std::abs(fast.area - exact.area) <= 1e-15 * size * largest);
    return exact.area > 0.0;
}

}  // namespace

TEST_CASE("a unit square and itself turned by 45 degrees share an octagon of area 2(sqrt 2 - 1)", "[overlap]") {
    const auto method = GENERATE(from_range(methods));
    const Polygon turned = rotated(unit_square(), std::numbers::pi / 4, {0.5, 0.5});
    CHECK(shared(unit_square(), turned, Point::Zero(), method).area ==
          Approx(2.0 * (std::numbers::sqrt2 - 1.0)).epsilon(1e-14));
}

TEST_CASE("two unit squares shifted by s share an area of 1 - s", "[overlap]") {
    const auto method = GENERATE(from_range(methods));
    const double s = GENERATE(0.0, 0x1p-30, 1e-9, 0.25, 0.5, 1.0 - 1e-11, 1.0 - 1e-12);
    CAPTURE(s);
    const OverlapArea<3> result = shared(unit_square(), unit_square(), {s, 0.0}, method);
    CHECK(result.area == Approx(1.0 - s).epsilon(s < 0.5 ? 1e-15 : 1e-16 / (1.0 - s)));
    if (s == 1.0 - 1e-12) return;  // what is left is as thin as the tolerance of `fast` for coinciding edges
    CHECK(result.area_gradient.x() == Approx(s > 0.0 ? -1.0 : 0.0).epsilon(1e-12));  // identical: half of + and half of -
    CHECK(std::abs(result.area_gradient.y()) < 1e-12);                               // both end together: the same
}

TEST_CASE("two unit squares shifted by s share exactly 1 - s where that is a double, and nothing from 1 on", "[overlap]") {
    const auto method = GENERATE(from_range(methods));
    for (const double s : {0.0, 0.25, 0.5, 0.75, 1.0 - 0x1p-20, 1.0 - 0x1p-52, 1.0 - 0x1p-53, 1.0, 1.0 + 0x1p-52, 2.0}) {
        CAPTURE(s);
        for (const Point& shift : {Point(s, 0), Point(-s, 0), Point(0, s), Point(0, -s)})
            CHECK(shared(unit_square(), unit_square(), shift, method).area == std::max(0.0, 1.0 - s));
    }
}

TEST_CASE("special positions share the area of elementary geometry, at every scale and place", "[overlap]") {
    const auto method = GENERATE(from_range(methods));
    for (const NamedPair& pair : special_positions())
        for (const Placement& place : placements()) {
            CAPTURE(pair.name, place.scale, place.offset.x());
            const Polygon face_1 = placed(pair.face_1, place.scale, place.offset),
                          face_2 = placed(pair.face_2, place.scale, place.offset);
            const double size = std::max(size_of(face_1), size_of(face_2));
            const double rounding = 4 * std::numeric_limits<double>::epsilon() * (place.offset.cwiseAbs().maxCoeff() + size);
            const OverlapArea<3> result = shared(face_1, face_2, Point::Zero(), method);
            CHECK(std::abs(result.area - pair.area * place.scale * place.scale) <= rounding * size);
            const bool is_exact = place.scale == std::exp2(std::round(std::log2(place.scale))) && place.offset.isZero(0.0);
            if (is_exact) CHECK((result.area > 0.0) == (pair.area > 0.0));
            if (result.area == 0.0) CHECK(result.area_gradient.isZero(0.0));
        }
}

TEST_CASE("faces that share only an edge or a vertex share nothing, wherever they are", "[overlap]") {
    const auto method = GENERATE(from_range(methods));
    std::mt19937 random(1);
    for (int trial = 0; trial < 300; ++trial) {
        CAPTURE(trial);
        const Point a(uniform(random, -1, 1), uniform(random, -1, 1)),
            b = a + Point(uniform(random, 0.1, 1), uniform(random, -1, 1));
        const Point along = b - a, left(-along.y(), along.x());
        const Point above = a + uniform(random, 0.1, 2) * left, below = a - uniform(random, 0.1, 2) * left;
        CHECK(shared({a, b, above}, {b, a, below}, Point::Zero(), method).area == 0.0);
        CHECK(shared({a, b, above}, {a, a - 0.5 * left - along, a - left}, Point::Zero(), method).area == 0.0);
    }
}

TEST_CASE("the triangles of a partition share areas with a face that add up to its own", "[overlap]") {
    const auto method = GENERATE(from_range(methods));
    std::mt19937 random(2);
    for (int trial = 0; trial < (method == AreaMethod::fast ? 50 : 3); ++trial) {
        const Polygon face = random_polygon(random, 3 + trial % 6, {0.5, 0.5}, 0.45);
        double sum = 0.0;
        Point derivative = Point::Zero();
        for (const Polygon& part : triangles_over_unit_square(8)) {
            const OverlapArea<3> result = shared(face, part, Point::Zero(), method);
            sum += result.area;
            derivative += result.area_gradient;
        }
        CHECK(sum == Approx(area_of(face)).epsilon(1e-13));
        CHECK(derivative.norm() < 1e-13);  // a partition that covers the face may slide: nothing changes
    }
}

TEST_CASE("matching triangulations share whole triangles, and sliding one over the other costs no area", "[overlap]") {
    const double noise = GENERATE(0.0, 1e-15, 1e-14);
    CAPTURE(noise);
    std::mt19937 random(3);
    const std::vector<Polygon> triangles = triangles_over_unit_square(5);
    for (const Polygon& face : triangles) {
        double sum = 0.0;
        Point derivative = Point::Zero();
        for (Polygon other : triangles) {
            for (Point& p : other) p += noise * Point(uniform(random, -1, 1), uniform(random, -1, 1));
            const OverlapArea<3> result = shared(face, other);
            sum += result.area;
            derivative += result.area_gradient;
        }
        CHECK(sum == Approx(area_of(face)).epsilon(1e-12));
        CHECK(derivative.norm() < 1e-12);  // every edge of its twin half, which adds up to 0; its neighbours nothing
    }
}

TEST_CASE("an edge of 2 that lies on an edge of 1 counts half, up to 1e-12 of the face size", "[overlap]") {
    const double off = GENERATE(0.0, 1e-14, -1e-14, 1e-13, -1e-13);
    CAPTURE(off);
    // The lower edges coincide; the upper one of face 2 lies inside.
    const Polygon face_2 = rectangle(0.25, off, 0.75, 0.5);
    const Point derivative = shared(unit_square(), face_2).area_gradient;
    CHECK(std::abs(derivative.x()) < 1e-12);
    CHECK(derivative.y() == Approx(0.5 - 0.25).epsilon(1e-12));
    CHECK(shared(unit_square(), rectangle(0.25, 1e-11, 0.75, 0.5)).area_gradient.norm() < 1e-12);
}

TEST_CASE("the half rule holds where a short edge lies on a long one and angles are noisy", "[overlap]") {
    std::mt19937 random(4);
    for (int trial = 0; trial < 200; ++trial) {
        const double x = uniform(random, 0.1, 0.8), width = std::pow(10.0, uniform(random, -6, -2));
        const auto jitter = [&] { return uniform(random, -1e-15, 1e-15); };
        const Polygon small = {{x, jitter()}, {x + width, jitter()}, {x + width, width}, {x, width}};
        CHECK(shared(unit_square(), small).area_gradient.y() == Approx(0.5 * width).epsilon(1e-6));
        CHECK(shared(small, unit_square()).area_gradient.y() == Approx(-0.5 * width).epsilon(1e-6));
        CHECK(shared(unit_square(), small).area == Approx(width * width).epsilon(1e-6));
    }
}

TEST_CASE("swapping the faces leaves the area and negates the derivative", "[overlap]") {
    const auto method = GENERATE(from_range(methods));
    std::mt19937 random(5);
    for (int trial = 0; trial < (method == AreaMethod::fast ? 2000 : 50); ++trial) {
        const Polygon face_1 = random_polygon(random, 3 + trial % 5, {0, 0}, 1.0);
        const Polygon face_2 = random_polygon(random, 3 + trial % 4, {uniform(random, -2, 2), uniform(random, -2, 2)},
                                              uniform(random, 0.3, 1.5));
        const Point shift(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1));
        const OverlapArea<3> forward = shared(face_1, face_2, shift, method),
                             backward = shared(face_2, face_1, -shift, method);
        CHECK(std::abs(forward.area - backward.area) < 1e-14);
        CHECK((forward.area_gradient + backward.area_gradient).norm() < 1e-13);
    }
}

TEST_CASE("fast and exact agree on thousands of random pairs", "[overlap]") {
    std::mt19937 random(6);
    int overlapping = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        CAPTURE(trial);
        const double scale = std::pow(10.0, trial % 19 - 9);
        const Polygon face_1 = random_polygon(random, 3 + trial % 2, {0, 0}, scale);
        const Polygon face_2 =
            random_polygon(random, 3 + trial % 3, scale * Point(uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5)),
                           scale * std::pow(10.0, uniform(random, -2, 0.5)));
        const Point shift = scale * Point(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1));
        const OverlapArea<3> fast = shared(face_1, face_2, shift), exact = shared(face_1, face_2, shift, AreaMethod::exact);
        const double size = std::max(size_of(face_1), size_of(face_2));
        CHECK((fast.area > 0.0) == (exact.area > 0.0));
        CHECK(std::abs(fast.area - exact.area) <= 1e-15 * size * size);
        CHECK((fast.area_gradient - exact.area_gradient).norm() <= 1e-13 * size);
        overlapping += exact.area > 0.0;
    }
    CHECK(overlapping > 1000);
    CHECK(overlapping < 2900);
}

TEST_CASE("fast and exact agree on special positions", "[overlap]") {
    for (const NamedPair& pair : special_positions()) {
        CAPTURE(pair.name);
        const OverlapArea<3> fast = shared(pair.face_1, pair.face_2),
                             exact = shared(pair.face_1, pair.face_2, Point::Zero(), AreaMethod::exact);
        CHECK((fast.area > 0.0) == (exact.area > 0.0));
        CHECK(std::abs(fast.area - exact.area) <= 4e-16);
        // The needles are thinner than the tolerance of `fast` for coinciding edges, which `exact` does not have.
        if (pair.name.find("needle") == std::string::npos && pair.name.find("last digit") == std::string::npos)
            CHECK((fast.area_gradient - exact.area_gradient).norm() <= 1e-13);
    }
}

TEST_CASE("slivers: the sign of the exact area decides, however thin", "[overlap]") {
    std::mt19937 random(7);
    for (int trial = 0; trial < 500; ++trial) {
        const Point a(0, 0), b(uniform(random, 0.5, 1), uniform(random, -1, 1)), c(uniform(random, -0.3, 0.3), 1.0);
        // Moves the neighbour across the shared edge by about the last digit, either way.
        const Point nudge = uniform(random, -3e-16, 3e-16) * Point(1, 1);
        check_same_decision({a, b, c}, {b + nudge, a + nudge, Point(0.1, -1.5)}, Point::Zero());
    }
    int tested = 0;
    // Needles along one line, each a few last digits wide, so that hardly any of their corners is right of all edges.
    for (int trial = 0; trial < 2000; ++trial) {
        const Point along(uniform(random, 0.5, 1), uniform(random, -1, 1)), left(-along.y(), along.x());
        const auto needle = [&] {
            const double start = uniform(random, -0.5, 0.5), width = std::pow(10.0, uniform(random, -16, -14));
            return Polygon{start * along, (start + uniform(random, 0.2, 1)) * along + uniform(random, -1, 1) * width * left,
                           (start + uniform(random, 0.0, 0.2)) * along + width * left};
        };
        const Polygon face_1 = counter_clockwise(needle()), face_2 = counter_clockwise(needle());
        if (std::min(area_of(face_1), area_of(face_2)) < 4e-16) continue;  // too thin to tell which way it runs
        check_same_decision(face_1, face_2, Point::Zero());
        ++tested;
    }
    CHECK(tested > 200);
}

TEST_CASE("fast and exact agree on whether faces that touch overlap, wherever they are and however they are shifted",
          "[overlap]") {
    const double largest_offset = GENERATE(0.0, 1.0, 1e3, 1e7), largest_shift = GENERATE(0.0, 1e-16, 0.1, 10.0, 1e7);
    CAPTURE(largest_offset, largest_shift);
    std::mt19937 random(9);
    int overlapping = 0;
    for (int trial = 0; trial < 300; ++trial) {
        CAPTURE(trial);
        const auto any_point = [&](double size) {
            return Point(uniform(random, -size, size), uniform(random, -size, size));
        };
        const Point a = any_point(largest_offset), b = a + Point(uniform(random, 0.1, 1), uniform(random, -1, 1)),
                    left(a.y() - b.y(), b.x() - a.x());
        const Point above = a + uniform(random, 0.1, 2) * left, below = b - uniform(random, 0.1, 2) * left;
        // The neighbour's edge is the whole edge, a part of it, or goes on beyond its end. It is put back by the shift.
        const Point end_1 = trial % 3 == 0 ? b : a + uniform(random, 0.5, 2) * (b - a),
                    end_2 = trial % 3 == 1 ? a + uniform(random, -1, 0.4) * (b - a) : a;
        const Point shift = any_point(largest_shift);
        const Polygon neighbour = counter_clockwise({end_1 - shift, end_2 - shift, below - shift});
        const Polygon quadrangle =
            counter_clockwise({end_1 - shift, end_2 - shift, end_2 - left - shift, end_1 - left - shift});
        overlapping += check_same_decision({a, b, above}, trial % 2 == 0 ? neighbour : quadrangle, shift);
    }
    const bool is_exact = largest_offset == 0.0 && largest_shift == 0.0;
    CHECK(overlapping < 300);
    if (largest_shift > 0.0 && !is_exact) CHECK(overlapping > 0);  // the sample holds both answers
}

TEST_CASE("the derivative is that of central differences away from events", "[overlap]") {
    std::mt19937 random(8);
    int tested = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Polygon face_1 = random_polygon(random, 3 + trial % 4, {0, 0}, 1.0);
        const Polygon face_2 = random_polygon(random, 3 + trial % 3, {uniform(random, -1, 1), uniform(random, -1, 1)}, 0.8);
        const Point shift(uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1));
        constexpr double step = 1e-4;
        std::vector<double> events;
        for (int axis = 0; axis < 2; ++axis)
            geometry::append_overlap_events<3>(face_1, face_2, shift - step * Point::Unit(axis),
                                               shift + step * Point::Unit(axis), events);
        if (!events.empty()) continue;  // between events the area is quadratic and the difference exact
        CHECK((shared(face_1, face_2, shift).area_gradient - central_difference(face_1, face_2, shift, step)).norm() <
              1e-10);
        ++tested;
    }
    CHECK(tested > 1500);
}

TEST_CASE("polygons of the largest size are cut as well", "[overlap]") {
    constexpr int n = geometry::max_polygon_vertices;
    Polygon circle;
    for (int i = 0; i < n; ++i)
        circle.emplace_back(std::cos(2 * std::numbers::pi * i / n), std::sin(2 * std::numbers::pi * i / n));
    const Polygon turned = rotated(circle, std::numbers::pi / n, {0, 0});
    // A regular 2n-gon about the common inner circle of radius cos(pi/n).
    const double inner = std::cos(std::numbers::pi / n);
    const double expected = 2 * n * inner * inner * std::tan(std::numbers::pi / (2 * n));
    for (const AreaMethod method : methods)
        CHECK(shared(circle, turned, Point::Zero(), method).area == Approx(expected).epsilon(1e-14));
}

TEST_CASE("polygons that rounding made slightly non-convex are cut as well", "[overlap]") {
    // 14 points on one edge, a last digit up and down, with the clipping line along them.
    Polygon comb;
    for (int i = 0; i < 14; ++i) comb.emplace_back(i / 13.0, (i % 2 ? 1e-16 : -1e-16));
    comb.emplace_back(1.0, 1.0);
    comb.emplace_back(0.0, 1.0);
    CHECK(shared(unit_square(), comb).area == Approx(1.0).epsilon(1e-14));
    CHECK(shared(comb, unit_square()).area == Approx(1.0).epsilon(1e-14));
}

TEST_CASE("a large offset costs no more digits than the coordinates have", "[overlap]") {
    // Features of 1e-3 at 1e7: the coordinates themselves are multiples of 2^-29 there.
    const Point far(1e7, -1e7);
    const double h = 0x1p-10, s = 0x1p-14;
    const Polygon face = placed(unit_square(), h, far);
    CHECK(shared(face, face, {s, 0.0}).area == Approx((h - s) * h).epsilon(1e-13));
    CHECK(shared(face, face, {1e-13, 0.0}).area ==
          Approx((h - 1e-13) * h).epsilon(1e-13));  // a shift far below the spacing of the coordinates
}

TEST_CASE("2D: segments share the length of elementary geometry", "[overlap][2d]") {
    const auto method = GENERATE(from_range(methods));
    const double scale = GENERATE(1.0, 0x1p-30, 0x1p30);
    struct Row {
        double lower, upper, length, derivative;
    };
    const Row row = GENERATE(Row{0.25, 0.75, 0.5, 0.0},  // inside
                             Row{-1, 2, 1.0, 0.0},       // around
                             Row{0.5, 2, 0.5, -1.0},     // beyond the right end
                             Row{-1, 0.5, 0.5, 1.0},     // beyond the left end
                             Row{0, 1, 1.0, 0.0},        // identical: half minus half
                             Row{0, 0.5, 0.5, 0.5},      // left ends together
                             Row{0.5, 1, 0.5, -0.5},     // right ends together
                             Row{0, 2, 1.0, -0.5},       // left ends together, longer
                             Row{1, 2, 0.0, 0.0},        // touching
                             Row{-1, 0, 0.0, 0.0},       // touching
                             Row{3, 4, 0.0, 0.0},        // apart
                             Row{0.5, 0.5, 0.0, 0.0},    // no length
                             Row{1 - 0x1p-53, 2, 0x1p-53, -1.0});
    CAPTURE(row.lower, row.upper, scale);
    const OverlapArea<2> result =
        shared_length(segment(0, scale), segment(scale * row.lower, scale * row.upper), 0.0, method);
    CHECK(result.area == scale * row.length);
    if (row.length > 1e-12) CHECK(result.area_gradient.x() == row.derivative);
    const OverlapArea<2> shifted =
        shared_length(segment(0, scale), segment(scale * (row.lower - 0.5), scale * (row.upper - 0.5)), 0.5 * scale, method);
    CHECK(shifted.area == Approx(scale * row.length).margin(1e-15 * scale));
}

TEST_CASE("2D: fast and exact agree on whether segments that touch overlap, wherever they are and however they are shifted",
          "[overlap][2d]") {
    std::mt19937 random(10);
    int overlapping = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const double offset = std::pow(10.0, uniform(random, -3, 7)),
                     shift = std::pow(10.0, uniform(random, -17, 3)) * (trial % 2 == 0 ? 1 : -1);
        const double end = offset + uniform(random, 0, 1), length_1 = uniform(random, 0.1, 1),
                     length_2 = uniform(random, 0.1, 1);
        const bool on_the_left = trial % 4 < 2;
        const Segment face_1 = segment(end - length_1, end);
        const Segment face_2 = on_the_left ? segment(face_1[0].x() - shift - length_2, face_1[0].x() - shift)
                                           : segment(end - shift, end - shift + length_2);
        const OverlapArea<2> fast = shared_length(face_1, face_2, shift, AreaMethod::fast),
                             swapped = shared_length(face_2, face_1, -shift, AreaMethod::fast);
        const OverlapArea<2> exact = shared_length(face_1, face_2, shift, AreaMethod::exact);
        const bool same = (fast.area > 0.0) == (exact.area > 0.0) && (swapped.area > 0.0) == (exact.area > 0.0);
        if (same && std::abs(fast.area - exact.area) <= 1e-15 * (std::abs(shift) + 1.0)) {
            overlapping += exact.area > 0.0;
            continue;
        }
        CAPTURE(trial, offset, shift, fast.area, exact.area);
        CHECK(same);
    }
    CHECK(overlapping > 1000);
    CHECK(overlapping < 19000);
}
