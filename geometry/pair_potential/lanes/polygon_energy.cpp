
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "abut/base/vector.hpp"
#include "abut/geometry/pair_potential/lanes/lane_energy_3d.hpp"

namespace abut::geometry::lanes {
namespace {

constexpr double tie = 1e-12;  // of the length of an edge: a corner this near to its line is on it

/// Bit i: on the line of the edge of the first triangle from corner i to the next one; bit 3 + i: the same of the second.
using LineSet = std::uint8_t;
constexpr LineSet lines_of_first = 0b000111, lines_of_second = 0b111000;

/// A corner of an overlap in the plane.
struct PlaneCorner {
    Vector<2> at;
    LineSet lines;
};

/// A polygon that is convex up to rounding, counter-clockwise. It begins as a triangle; each of three cuts adds one corner
/// at most.
struct PlanePolygon {
    static constexpr int capacity = 6;

    std::array<PlaneCorner, capacity> corner;
    int size = 0;

    void append(const PlaneCorner& added) {
        if (size == capacity)
            throw std::logic_error("pair potential: a polygon with more corners than three cuts of a triangle can have");
        corner[static_cast<std::size_t>(size++)] = added;
    }
};

using CornerValues = std::array<double, PlanePolygon::capacity>;

Vector<2> vector_of(const LaneVector<double, 2>& a) { return {a.c[0], a.c[1]}; }

double cross(const Vector<2>& a, const Vector<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Number of changes of sign around the polygon.
int sign_changes(const CornerValues& value, int size) {
    unsigned positive = 0;
    for (int i = 0; i < size; ++i) positive |= static_cast<unsigned>(value[i] > 0.0) << i;
    const unsigned of_next = positive >> 1 | (positive & 1u) << (size - 1);
    return std::popcount(positive ^ of_next);
}

/// A line enters and leaves a convex polygon once. Corners that rounding puts inside apart from the run around the innermost
/// one are on the line.
void keep_one_run(CornerValues& value, int size) {
    const int innermost = static_cast<int>(std::max_element(value.begin(), value.begin() + size) - value.begin());
    std::array<bool, PlanePolygon::capacity> is_kept{};
    for (int i = innermost; value[i] > 0.0 && !is_kept[i]; i = i + 1 < size ? i + 1 : 0) is_kept[i] = true;
    is_kept[innermost] = false;
    for (int i = innermost; value[i] > 0.0 && !is_kept[i]; i = i > 0 ? i - 1 : size - 1) is_kept[i] = true;
    for (int i = 0; i < size; ++i)
        if (!is_kept[i]) value[i] = std::min(value[i], 0.0);
}

/// Cuts a polygon by the line on which `inside` is 0, and keeps what has more: one corner more at most, whatever rounding
/// has done to it. A new corner is on `line`, and on all that the corner is on whose position it takes, up to rounding.
void cut(PlanePolygon& polygon, CornerValues& inside, LineSet line) {
    if (sign_changes(inside, polygon.size) > 2) keep_one_run(inside, polygon.size);
    PlanePolygon kept;
    for (int i = 0; i < polygon.size; ++i) {
        const int next = i + 1 < polygon.size ? i + 1 : 0;
        const PlaneCorner &from = polygon.corner[i], &to = polygon.corner[next];
        if (inside[i] > 0.0) kept.append(from);
        if ((inside[i] > 0.0) == (inside[next] > 0.0)) continue;
        const double at = inside[i] / (inside[i] - inside[next]);
        const PlaneCorner& outer = inside[i] > 0.0 ? to : from;
        const LineSet lines = (outer.lines & line) != 0 ? outer.lines : (from.lines & to.lines) | line;
        kept.append({from.at + at * (to.at - from.at), lines});
    }
    polygon = kept;
}

using Triangle = std::array<Vector<2>, 3>;

PlanePolygon overlap_of(const Triangle& first, const Triangle& second) {
    PlanePolygon polygon;
    constexpr std::array<LineSet, 3> lines_at_corner{0b101, 0b011, 0b110};  // those of the edges that meet there
    for (std::size_t i = 0; i < 3; ++i) polygon.append({first[i], lines_at_corner[i]});
    for (std::size_t i = 0; i < 3 && polygon.size > 0; ++i) {
        const Vector<2> along = second[(i + 1) % 3] - second[i];
        const double tolerance = tie * along.squaredNorm();
        const auto line = static_cast<LineSet>(0b001000 << i);
        CornerValues inside;
        for (int c = 0; c < polygon.size; ++c) {
            inside[c] = cross(along, polygon.corner[c].at - second[i]);
            if (std::abs(inside[c]) <= tolerance) polygon.corner[c].lines |= line;
        }
        cut(polygon, inside, line);
    }
    return polygon;
}

/// The edges of a polygon, as parts of the edges of both triangles: an edge of both twice, half each.
struct PolygonOutline {
    explicit PolygonOutline(const SeenPair<double>& seen) {
        std::array<Triangle, 2> triangles;
        for (int k = 0; k < 6; ++k)
            triangles[static_cast<std::size_t>(k / 3)][static_cast<std::size_t>(k % 3)] =
                vector_of(seen.plane[Outline<double>::corners[k][0]]);
        const PlanePolygon polygon = overlap_of(triangles[0], triangles[1]);
        for (int i = 0; i < polygon.size; ++i) {
            const PlaneCorner &from = polygon.corner[i], &to = polygon.corner[i + 1 < polygon.size ? i + 1 : 0];
            const LineSet lines = from.lines & to.lines;
            const double weight = (lines & lines_of_first) != 0 && (lines & lines_of_second) != 0 ? 0.5 : 1.0;
            for (const LineSet of_triangle : {lines_of_first, lines_of_second})
                if ((lines & of_triangle) != 0)
                    append(seen, std::countr_zero(static_cast<unsigned>(lines & of_triangle)), from.at, to.at, weight);
        }
    }
    [[nodiscard]] int start(int k) const { return Outline<double>::corners[edge[k]][0]; }
    [[nodiscard]] int end(int k) const { return Outline<double>::corners[edge[k]][1]; }

    EdgePart<double> part[2 * PlanePolygon::capacity];
    int edge[2 * PlanePolygon::capacity];
    int n = 0;

private:
    void append(const SeenPair<double>& seen, int of_edge, const Vector<2>& from, const Vector<2>& to, double weight) {
        edge[n] = of_edge;
        const Vector<2> corner = vector_of(seen.plane[start(n)]), along = vector_of(seen.plane[end(n)]) - corner;
        const double over_squared_length = 1.0 / along.squaredNorm();
        EdgePart<double>& added = part[n++] = {{from[0], from[1]}, {to[0], to[1]}};
        added.low = over_squared_length * along.dot(from - corner);
        added.high = over_squared_length * along.dot(to - corner);
        added.weight = weight;
    }
};

}  // namespace

LaneEnergy<double, 3> energy_by_polygon(const LaneCorners<double, 3>& z, const LaneLaw<double>& law) {
    const SeenPair<double> seen(z, law.offset);
    PolygonOutline outline(seen);
    return energy_in(outline, seen, law);
}

}  // namespace abut::geometry::lanes
