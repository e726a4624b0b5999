#include "abut/geometry/nearest_points.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace abut::geometry {
namespace {

using ThreeCorners = std::array<Vector<3>, 3>;

void take(NearestPoints& best, const Vector<3>& point_1, const Vector<3>& point_2) {
    if (const double distance = (point_2 - point_1).norm(); distance < best.distance) best = {point_1, point_2, distance};
}

/// Ericson, Real-Time Collision Detection (2005), section 5.1.5.
Vector<3> nearest_of_triangle(const ThreeCorners& triangle, const Vector<3>& x) {
    const auto& [a, b, c] = triangle;
    const Vector<3> ab = b - a, ac = c - a;
    const double d1 = ab.dot(x - a), d2 = ac.dot(x - a);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const double d3 = ab.dot(x - b), d4 = ac.dot(x - b);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double over_c = d1 * d4 - d3 * d2;
    if (over_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 > d3) return a + d1 / (d1 - d3) * ab;
    const double d5 = ab.dot(x - c), d6 = ac.dot(x - c);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double over_b = d5 * d2 - d1 * d6;
    if (over_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 > d6) return a + d2 / (d2 - d6) * ac;
    const double over_a = d3 * d6 - d5 * d4, past_b = d4 - d3, past_c = d5 - d6;
    if (over_a <= 0.0 && past_b >= 0.0 && past_c >= 0.0 && past_b + past_c > 0.0)
        return b + past_b / (past_b + past_c) * (c - b);
    const double sum = over_a + over_b + over_c;
    return sum > 0.0 ? Vector<3>(a + over_b / sum * ab + over_c / sum * ac) : a;
}

double clamped_ratio(double over, double under) { return under > 0.0 ? std::clamp(over / under, 0.0, 1.0) : 0.0; }

/// Ericson, section 5.1.9.
void take_segments(NearestPoints& best, const Vector<3>& p1, const Vector<3>& q1, const Vector<3>& p2, const Vector<3>& q2) {
    const Vector<3> d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
    const double a = d1.squaredNorm(), e = d2.squaredNorm(), b = d1.dot(d2), c = d1.dot(r), f = d2.dot(r);
    double s = clamped_ratio(b * f - c * e, a * e - b * b);
    const double t = clamped_ratio(b * s + f, e);
    s = clamped_ratio(b * t - c, a);
    take(best, p1 + s * d1, p2 + t * d2);
}

/// Takes the point where a segment goes through a triangle, if it does.
void take_crossing(NearestPoints& best, const Vector<3>& p, const Vector<3>& q, const ThreeCorners& triangle) {
    const auto& [a, b, c] = triangle;
    const Vector<3> normal = (b - a).cross(c - a);
    const double from = normal.dot(p - a), to = normal.dot(q - a);
    if ((from > 0.0) == (to > 0.0) || from == to) return;
    const Vector<3> x = p + from / (from - to) * (q - p);
    for (const auto& [start, end] : {std::pair{a, b}, {b, c}, {c, a}})
        if (!(normal.dot((end - start).cross(x - start)) >= 0.0)) return;
    best = {x, x, 0.0};
}

void take_triangles(NearestPoints& best, const ThreeCorners& one, const ThreeCorners& two) {
    for (const Vector<3>& x : one) take(best, x, nearest_of_triangle(two, x));
    for (const Vector<3>& x : two) take(best, nearest_of_triangle(one, x), x);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) take_segments(best, one[i], one[(i + 1) % 3], two[k], two[(k + 1) % 3]);
    for (std::size_t i = 0; i < 3 && best.distance > 0.0; ++i) {
        take_crossing(best, one[i], one[(i + 1) % 3], two);
        take_crossing(best, two[i], two[(i + 1) % 3], one);
    }
}

}  // namespace

/// By coordinates from a corner: far from the origin nothing is lost.
NearestPoints nearest_points(std::span<const Vector<3>> face_1, std::span<const Vector<3>> face_2) {
    const Vector<3> origin = face_1[0];
    NearestPoints best;
    for (std::size_t i = 2; i < face_1.size(); ++i)
        for (std::size_t k = 2; k < face_2.size(); ++k)
            take_triangles(best, {Vector<3>::Zero(), face_1[i - 1] - origin, face_1[i] - origin},
                           {face_2[0] - origin, face_2[k - 1] - origin, face_2[k] - origin});
    best.point_1 += origin;
    best.point_2 += origin;
    return best;
}

}  // namespace abut::geometry
