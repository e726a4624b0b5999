#include "abut/geometry/pair_potential/plane_overlap.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

namespace abut::geometry {
namespace {

constexpr double tie = 1e-12;      // of the length of an edge: a corner this near to its line is on it
constexpr double no_area = 1e-15;  // of the product of the lengths of two edges

double cross(const Vector<2>& a, const Vector<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

using CornerValues = std::array<double, PlanePolygon::capacity>;

/// Number of changes of sign around the polygon.
int sign_changes(const CornerValues& value, int size) {
    unsigned negative = 0;
    for (int i = 0; i < size; ++i) negative |= static_cast<unsigned>(value[i] < 0.0) << i;
    const unsigned of_next = negative >> 1 | (negative & 1u) << (size - 1);
    return std::popcount(negative ^ of_next);
}

/// A line enters and leaves a convex polygon once. Corners that rounding puts below 0 apart from the run around the lowest
/// one are on the line.
void keep_one_run(CornerValues& value, int size) {
    const int lowest = static_cast<int>(std::min_element(value.begin(), value.begin() + size) - value.begin());
    std::array<bool, PlanePolygon::capacity> is_kept{};
    for (int i = lowest; value[i] < 0.0 && !is_kept[i]; i = i + 1 < size ? i + 1 : 0) is_kept[i] = true;
    is_kept[lowest] = false;
    for (int i = lowest; value[i] < 0.0 && !is_kept[i]; i = i > 0 ? i - 1 : size - 1) is_kept[i] = true;
    for (int i = 0; i < size; ++i)
        if (!is_kept[i]) value[i] = std::max(value[i], 0.0);
}

/// Cuts a polygon by the line on which `value` is 0, and keeps what has less: one corner more at most, whatever rounding has
/// done to it. A new corner is on `line`, and on all that the corner is on whose place it takes, up to rounding.
void cut(PlanePolygon& polygon, CornerValues& value, LineSet line) {
    if (sign_changes(value, polygon.size) > 2) keep_one_run(value, polygon.size);
    PlanePolygon kept;
    for (int i = 0; i < polygon.size; ++i) {
        const int next = i + 1 < polygon.size ? i + 1 : 0;
        const PlaneCorner &from = polygon.corner[i], &to = polygon.corner[next];
        if (value[i] < 0.0) kept.append(from);
        if ((value[i] < 0.0) == (value[next] < 0.0)) continue;
        const double at = value[i] / (value[i] - value[next]);
        const PlaneCorner& outer = value[i] < 0.0 ? to : from;
        const LineSet lines = (outer.lines & line) != 0 ? outer.lines : (from.lines & to.lines) | line;
        kept.append({from.at + at * (to.at - from.at), lines, from.gap + at * (to.gap - from.gap)});
    }
    polygon = kept;
}

/// Cuts a polygon by the line of an edge of face 2 and keeps what is on the inner side.
void cut_by_edge(PlanePolygon& polygon, const Vector<2>& start, const Vector<2>& end, LineSet line) {
    const Vector<2> along = end - start;
    const double tolerance = tie * along.squaredNorm();
    CornerValues outside;
    for (int i = 0; i < polygon.size; ++i) {
        // face 2 runs clockwise: its inside is on the right
        outside[i] = cross(along, polygon.corner[i].at - start);
        if (std::abs(outside[i]) <= tolerance) polygon.corner[i].lines |= line;
    }
    cut(polygon, outside, line);
}

/// The point of a segment that is nearest to another point.
Vector<2> nearest_on(const Vector<2>& a, const Vector<2>& b, const Vector<2>& point) {
    const Vector<2> along = b - a;
    return a + std::clamp(along.dot(point - a) / along.squaredNorm(), 0.0, 1.0) * along;
}

}  // namespace

void refuse_corner() {
    throw std::logic_error("pair potential: a polygon with more corners than a cut of triangles can have");
}

PlanePolygon overlap_in_plane(const std::array<Vector<2>, 6>& corners) {
    PlanePolygon polygon;
    constexpr std::array<LineSet, 3> lines_at_corner{0b101, 0b011, 0b110};  // those of the edges that meet there
    for (int i = 0; i < 3; ++i) polygon.append({corners[i], lines_at_corner[i], 0.0});
    for (int i = 0; i < 3 && polygon.size > 0; ++i)
        cut_by_edge(polygon, corners[3 + i], corners[3 + (i + 1) % 3], static_cast<LineSet>(0b001000 << i));
    return polygon;
}

void keep_negative_gap(PlanePolygon& polygon) {
    CornerValues gap;
    bool all_negative = true;
    for (int i = 0; i < polygon.size; ++i) {
        gap[i] = polygon.corner[i].gap;
        all_negative = all_negative && gap[i] < 0.0;
    }
    if (!all_negative) cut(polygon, gap, 0);
}

bool has_area(const PlanePolygon& polygon, const std::array<Vector<2>, 6>& corners) {
    if (polygon.size < 3) return false;
    double twice_area = 0.0;
    for (int i = 1; i + 1 < polygon.size; ++i)
        twice_area += cross(polygon.corner[i].at - polygon.corner[0].at, polygon.corner[i + 1].at - polygon.corner[0].at);
    const auto size = [&](int face) {
        return (corners[3 * face + 1] - corners[3 * face]).squaredNorm() +
               (corners[3 * face + 2] - corners[3 * face]).squaredNorm();
    };
    return twice_area > no_area * std::min(size(0), size(1));
}

Vector<2> halfway_between(const std::array<Vector<2>, 6>& corners) {
    double least = std::numeric_limits<double>::infinity();
    Vector<2> halfway = corners[0];
    const auto offer = [&](const Vector<2>& a, const Vector<2>& b) {
        if (const double distance = (a - b).squaredNorm(); distance < least) {
            least = distance;
            halfway = 0.5 * (a + b);
        }
    };
    for (int face = 0; face < 2; ++face)
        for (int v = 0; v < 3; ++v)
            for (int edge = 0; edge < 3; ++edge) {
                const Vector<2>& point = corners[3 * face + v];
                const int other = 3 * (1 - face);
                offer(point, nearest_on(corners[other + edge], corners[other + (edge + 1) % 3], point));
            }
    return halfway;
}

}  // namespace abut::geometry
