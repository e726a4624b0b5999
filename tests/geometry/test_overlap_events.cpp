#include <array>
#include <catch2/catch.hpp>

#include "polygons.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using geometry::append_overlap_events;

namespace {

std::vector<double> events_of(const Polygon& face_1, const Polygon& face_2, const Point& shift_0, const Point& shift_1) {
    std::vector<double> events;
    append_overlap_events<3>(face_1, face_2, shift_0, shift_1, events);
    std::sort(events.begin(), events.end());
    return events;
}

// 0, the events and 1.
std::vector<double> cuts_of(const Polygon& face_1, const Polygon& face_2, const Point& shift_0, const Point& shift_1) {
    std::vector<double> cuts = events_of(face_1, face_2, shift_0, shift_1);
    cuts.insert(cuts.begin(), 0.0);
    cuts.push_back(1.0);
    return cuts;
}

// Third divided difference, times the cube of the length: zero for polynomials of degree 2.
template <class Function>
double cubic_part(const Function& f, double a, double b) {
    return f(b) - 3.0 * f(a + 2.0 / 3.0 * (b - a)) + 3.0 * f(a + (b - a) / 3.0) - f(a);
}

}  // namespace

TEST_CASE("a square that slides over another has events where the edges pass", "[events]") {
    // From x = 2 to x = -2: right edge on left edge, both aligned, left on right; at y = 1/4 nothing else.
    const std::vector<double> events = events_of(unit_square(), rectangle(0, 0.25, 1, 0.5), {2, 0}, {-2, 0});
    REQUIRE(!events.empty());
    for (const double tau : events)
        CHECK(std::min({std::abs(tau - 0.25), std::abs(tau - 0.5), std::abs(tau - 0.75)}) < 1e-15);
    for (const double expected : {0.25, 0.5, 0.75})
        CHECK(std::any_of(events.begin(), events.end(), [&](double tau) { return std::abs(tau - expected) < 1e-15; }));
}

TEST_CASE("no events without crossings: at rest, apart, inside, along an edge", "[events]") {
    CHECK(events_of(unit_square(), unit_square(), {0.5, 0.5}, {0.5, 0.5}).empty());
    CHECK(events_of(unit_square(), unit_square(), {3, 0}, {5, 0.5}).empty());
    CHECK(events_of(rectangle(0, 0, 4, 4), unit_square(), {1, 1}, {2, 2}).empty());
    CHECK(events_of(rectangle(0, 0, 4, 4), unit_square(), {1, 0}, {2, 0}).empty());
    CHECK(events_of(unit_square(), unit_square(), {0, 0}, {0, 0}).empty());
}

TEST_CASE("an edge's line crossed beyond the edge is no event", "[events]") {
    CHECK(events_of(unit_square(), rectangle(0, 3, 0.5, 4), {-0.25, 0}, {0.25, 0}).empty());
}

TEST_CASE("events are added to those already there", "[events]") {
    std::vector<double> events = {0.125};
    append_overlap_events<3>(unit_square(), unit_square(), Point(2, 0.25), Point(-2, 0.25), events);
    CHECK(events.front() == 0.125);
    CHECK(events.size() > 3);
}

TEST_CASE("between neighbouring events the area is a quadratic in tau, and across them it is not", "[events]") {
    std::mt19937 random(11);
    double worst_between = 0.0;
    int broken_across = 0, paths_with_events = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const double scale = std::pow(10.0, trial % 19 - 9);
        const Polygon face_1 = random_polygon(random, 3 + trial % 3, {0, 0}, scale);
        const Polygon face_2 = random_polygon(random, 3 + trial % 4, {0, 0}, scale * uniform(random, 0.3, 1.5));
        const Point shift_0 = scale * Point(uniform(random, -2, 2), uniform(random, -2, 2)),
                    shift_1 = scale * Point(uniform(random, -2, 2), uniform(random, -2, 2));
        const auto area = [&](double tau) {
            return shared(face_1, face_2, shift_0 + tau * (shift_1 - shift_0)).area / (scale * scale);
        };
        const std::vector<double> cuts = cuts_of(face_1, face_2, shift_0, shift_1);
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
            raise(worst_between, std::abs(cubic_part(area, cuts[k], cuts[k + 1])));
        if (cuts.size() == 2) continue;
        ++paths_with_events;
        if (std::abs(cubic_part(area, 0.0, 1.0)) > 1e-3) ++broken_across;
    }
    CHECK(worst_between < 1e-13);
    CHECK(paths_with_events > 500);
    CHECK(broken_across > paths_with_events / 2);
}

TEST_CASE("the derivative integrated with two Gauss points between events is the change of area", "[events]") {
    std::mt19937 random(12);
    for (int trial = 0; trial < 500; ++trial) {
        CAPTURE(trial);
        const Polygon face_1 = random_polygon(random, 3, {0, 0}, 1.0),
                      face_2 = random_polygon(random, 3 + trial % 2, {0, 0}, uniform(random, 0.3, 1.5));
        const Point shift_0(uniform(random, -2, 2), uniform(random, -2, 2)),
            shift_1(uniform(random, -2, 2), uniform(random, -2, 2));
        const Point motion = shift_1 - shift_0;
        const std::vector<double> cuts = cuts_of(face_1, face_2, shift_0, shift_1);
        double integral = 0.0;
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
            for (const double point : {0.5 - std::sqrt(3.0) / 6.0, 0.5 + std::sqrt(3.0) / 6.0}) {
                const double tau = cuts[k] + point * (cuts[k + 1] - cuts[k]);
                integral +=
                    0.5 * (cuts[k + 1] - cuts[k]) * shared(face_1, face_2, shift_0 + tau * motion).area_gradient.dot(motion);
            }
        CHECK(std::abs(integral - (shared(face_1, face_2, shift_1).area - shared(face_1, face_2, shift_0).area)) < 1e-13);
    }
}

TEST_CASE("matching meshes that slide along a direction of their edges keep the law", "[events]") {
    // Squares on a grid: edges coincide with others during the whole motion, and vertices pass vertices.
    const Polygon face = unit_square();
    for (const Point& start : {Point(-1, 0), Point(0, -1), Point(-1, -1), Point(0, 0)}) {
        const Point motion(2.0, 0.0);
        const std::vector<double> cuts = cuts_of(face, face, start, start + motion);
        double integral = 0.0;
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
            const double middle = 0.5 * (cuts[k] + cuts[k + 1]);
            integral += (cuts[k + 1] - cuts[k]) * shared(face, face, start + middle * motion).area_gradient.dot(motion);
        }
        CHECK(integral == Approx(shared(face, face, start + motion).area - shared(face, face, start).area).margin(1e-14));
    }
}

TEST_CASE("2D: ends passing ends are the events, and the length is linear between them", "[events][2d]") {
    const std::array<PlaneVector<2>, 2> face_1{PlaneVector<2>(0.0), PlaneVector<2>(1.0)},
        face_2{PlaneVector<2>(0.0), PlaneVector<2>(0.5)};
    std::vector<double> events;
    append_overlap_events<2>(face_1, face_2, PlaneVector<2>(-1.0), PlaneVector<2>(3.0), events);
    std::sort(events.begin(), events.end());
    CHECK(events == std::vector<double>{0.125, 0.25, 0.375, 0.5});
    events.clear();
    append_overlap_events<2>(face_1, face_2, PlaneVector<2>(0.1), PlaneVector<2>(0.2), events);
    append_overlap_events<2>(face_1, face_2, PlaneVector<2>(0.1), PlaneVector<2>(0.1), events);
    append_overlap_events<2>(face_1, face_2, PlaneVector<2>(0.0), PlaneVector<2>(0.1),
                             events);  // ends together at the start only
    CHECK(events.empty());
}
