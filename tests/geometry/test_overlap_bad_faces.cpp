// Faces that are none: without area, or with numbers that are not finite.
#include <array>
#include <catch2/catch.hpp>
#include <limits>

#include "abut/base/error.hpp"
#include "polygons.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Matchers::Contains;
using geometry::overlap_area;
using geometry::overlap_polygon;
using geometry::TrianglePair;

namespace {

constexpr std::array both_methods{AreaMethod::fast, AreaMethod::exact};

using Segment = std::array<PlaneVector<2>, 2>;

Segment line(double lower, double upper) { return {PlaneVector<2>(lower), PlaneVector<2>(upper)}; }

// Along the line from a by d: whether corners lie on one line is exact where a and d are small multiples of powers of two;
// needles and points have none of an area wherever they are.
std::vector<Polygon> faces_without_area(const Point& a, const Point& d) {
    const Point b = a + d, c = a + 2.0 * d;
    return {{a, a, a}, {a, a, b}, {a, b, b}, {a, b, a},    {a, b, c},    {a, c, b},       {b, a, c},
            {c, a, b}, {c, b, a}, {b, c, a}, {a, a, a, a}, {a, b, b, a}, {a, a, b, b, b}, {a, b, c, b}};
}

std::vector<Polygon> proper_faces() {
    return {{{0, 0}, {1, 0}, {0, 1}},       {{-1, -1}, {3, -1}, {-1, 3}}, {{5, 5}, {6, 5}, {5, 6}},
            {{-9, -9}, {-8, -9}, {-9, -8}}, rectangle(-2, -2, 2, 2),      rectangle(0.25, 0.25, 0.5, 0.5),
            rectangle(-40, -40, 40, -39)};
}

bool is_nothing(const OverlapArea<3>& shared) { return shared.area == 0.0 && shared.area_gradient.isZero(0.0); }

TrianglePair triangles(const Polygon& face_1, const Polygon& face_2, const Point& shift) {
    return {{face_1[0], face_1[1], face_1[2]}, {face_2[0], face_2[1], face_2[2]}, shift};
}

void check_shares_nothing(const Polygon& flat, const Polygon& other, const Point& shift) {
    CAPTURE(flat[0], flat[1], flat[2], other[0], shift);
    for (const AreaMethod method : both_methods) {
        CHECK(is_nothing(shared(flat, other, shift, method)));
        CHECK(is_nothing(shared(other, flat, -shift, method)));
    }
    CHECK(overlap_polygon<3>(flat, other).empty());
    CHECK(overlap_polygon<3>(other, flat).empty());
    if (flat.size() > 3 || other.size() > 3) return;
    const std::array pairs{triangles(flat, other, shift), triangles(other, flat, -shift)};
    std::array<OverlapArea<3>, 2> areas;
    geometry::overlap_areas(pairs, areas);
    CHECK(is_nothing(areas[0]));
    CHECK(is_nothing(areas[1]));
}

}  // namespace

TEST_CASE("a point, a line and a needle with equal corners share nothing with any face, in any method and order",
          "[overlap][batch]") {
    for (const Placement& place : placements()) {
        if (place.scale != std::exp2(std::round(std::log2(place.scale)))) continue;  // others round lines to triangles
        const auto put = [&](const Polygon& face) { return placed(face, place.scale, place.offset); };
        for (const Point& direction : {Point(1, 0), Point(0, 1), Point(1, 1), Point(0.75, -0.25)})
            for (const Polygon& flat : faces_without_area({0.25, 0.25}, direction))
                for (const Polygon& other : proper_faces()) {
                    check_shares_nothing(put(flat), put(other), Point::Zero());
                    check_shares_nothing(put(flat), put(other), place.scale * Point(0.1, -0.3));
                }
    }
}

TEST_CASE("faces without area share nothing with each other", "[overlap][batch]") {
    for (const Polygon& flat : faces_without_area({0.25, 0.25}, {1, 0.5}))
        for (const Polygon& other : faces_without_area({0.25, 0.25}, {0.5, 1}))
            check_shares_nothing(flat, other, Point::Zero());
}

TEST_CASE("a needle with two equal corners shares nothing wherever it points", "[overlap][batch]") {
    std::mt19937 random(1);
    const auto any_point = [&] { return Point(uniform(random, -1, 1), uniform(random, -1, 1)); };
    for (int trial = 0; trial < 200; ++trial) {
        const Point a = any_point(), b = any_point();
        const Polygon other = random_polygon(random, 3 + trial % 2, any_point(), std::pow(10.0, uniform(random, -3, 1)));
        for (const Polygon& flat : {Polygon{a, a, b}, Polygon{a, b, b}, Polygon{a, b, a}, Polygon{a, a, a}})
            check_shares_nothing(flat, other, 0.1 * any_point());
    }
}

TEST_CASE("2D: a segment of no length shares nothing", "[overlap][2d]") {
    for (const AreaMethod method : both_methods)
        for (const double at : {-1.0, 0.0, 0.25, 1.0, 2.0})
            for (const double shift : {0.0, 0.3}) {
                CHECK(overlap_area<2>(line(at, at), line(0, 1), PlaneVector<2>(shift), method).area == 0.0);
                CHECK(overlap_area<2>(line(0, 1), line(at, at), PlaneVector<2>(shift), method).area == 0.0);
                CHECK(overlap_polygon<2>(line(at, at), line(0, 1)).empty());
            }
}

TEST_CASE("a coordinate or a shift that is not finite is refused, in any method", "[overlap][batch][errors]") {
    const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity());
    const TrianglePair good = triangles({{0, 0}, {1, 0}, {0, 1}}, {{0, 0}, {2, 0}, {0, 2}}, {0.1, 0.1});
    const auto check_refused = [](const TrianglePair& pair, const std::string& says) {
        for (const AreaMethod method : both_methods) {
            const auto overlap = [&] { return overlap_area<3>(pair.face_1, pair.face_2, pair.shift, method); };
            CHECK_THROWS_AS(overlap(), BadInput);
            CHECK_THROWS_WITH(overlap(), Contains(says) && Contains("must be finite"));
        }
        std::array<OverlapArea<3>, 1> areas;
        CHECK_THROWS_WITH(geometry::overlap_areas(std::span(&pair, 1), areas), Contains(says));
    };
    for (int axis = 0; axis < 2; ++axis) {
        for (int i = 0; i < 3; ++i) {
            TrianglePair pair = good;
            pair.face_1[i][axis] = bad;
            check_refused(pair, "corner " + std::to_string(i) + " of face 1");
            CHECK_THROWS_AS(overlap_polygon<3>(pair.face_1, pair.face_2), BadInput);
            pair = good;
            pair.face_2[i][axis] = bad;
            check_refused(pair, "corner " + std::to_string(i) + " of face 2");
            CHECK_THROWS_AS(overlap_polygon<3>(pair.face_1, pair.face_2), BadInput);
        }
        TrianglePair pair = good;
        pair.shift[axis] = bad;
        check_refused(pair, "the shift");
    }
    for (const AreaMethod method : both_methods) {
        const auto overlap = [&](const Segment& face_1, const Segment& face_2, double shift) {
            return overlap_area<2>(face_1, face_2, PlaneVector<2>(shift), method);
        };
        CHECK_THROWS_WITH(overlap(line(0, bad), line(0, 1), 0.0), Contains("corner 1 of face 1"));
        CHECK_THROWS_WITH(overlap(line(0, 1), line(bad, 1), 0.0), Contains("corner 0 of face 2"));
        CHECK_THROWS_WITH(overlap(line(0, 1), line(0, 1), bad), Contains("the shift"));
    }
    CHECK_THROWS_AS(overlap_polygon<2>(line(0, bad), line(0, 1)), BadInput);
}
