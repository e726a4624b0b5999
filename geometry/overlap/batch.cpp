#include "abut/geometry/overlap/batch.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/simd.hpp"
#include "abut/geometry/overlap/kernels.hpp"
#include "abut/geometry/overlap/lane_heights.hpp"

namespace abut::geometry {
namespace {

// A height is cross(edge, arm) of coordinates of size E. What was rounded before (three times 2^-53 E, where a is shifted),
// the differences, the products and their difference make it uncertain by less than 80 * 2^-53 E^2 = 9e-15 E^2. The limit
// is larger so that edges which coincide within the tolerance are within it, too, where `Close` sees to them: their heights
// are at most tolerance * (face size <= 2 E) * (edge length <= 2.9 E).
constexpr double least_certain_height = 8.0 * coincidence_tolerance;

// Of coordinates: what is multiplied here, four of them at most, is then neither too large nor too small for a double.
constexpr double least_extent = 1e-60, largest_extent = 1e70;

struct LanePair {
    TriangleLanes a, b;
    PlaneLanes a_from_b[3];  // corners of a seen from corner 0 of b
    Lanes limit;             // least certain height
    LaneMask is_proper;      // neither triangle is too thin, too small or too large
    LaneMask is_given;       // coordinates are those to decide on

    LaneMask is_proper_face(const TriangleLanes& t) const {
        const Lanes twice_area = cross(t.edge[0], t.edge[1]);
        return (twice_area > limit) &
               (twice_area > thin_face * larger(dot(t.edge[0], t.edge[0]), dot(t.edge[1], t.edge[1])));
    }

    LanePair(const TriangleBatch& batch, int first) : a(batch.x_a, batch.y_a, first), b(batch.x_b, batch.y_b, first) {
        const Lanes shift = load_lanes(&batch.rounded_shift[first]);
        Lanes extent = shift;
        const auto include = [&extent](PlaneLanes p) { extent = larger(extent, larger(absolute(p.x), absolute(p.y))); };
        for (int i = 0; i < 3; ++i) {
            a_from_b[i] = a.corner[i] - b.corner[0];
            include(a_from_b[i]);
        }
        include(b.edge[0]);
        include(b.edge[2]);
        limit = least_certain_height * (extent * extent);
        is_proper = is_proper_face(a) & is_proper_face(b) & (extent > least_extent) & (extent < largest_extent);
        is_given = shift == 0.0;
    }
};

// Whether a step by (e, e^2), with e > 0 as small as one likes, goes to the left of the direction.
LaneMask leans_left(PlaneLanes direction) { return (direction.y < 0.0) | ((direction.y == 0.0) & (direction.x > 0.0)); }

// Which corners are inside the edges of the other triangle. Heights that are zero are decided as if b were moved by
// (e, e^2): this is a choice of triangles in general position, whose area differs by less than any number.
struct Sides {
    LaneMask a[3][3], b[3][3];  // corner i of a, of b inside edge j of the other: [j][i]

    Sides(const Heights& a_over_b, const Heights& b_over_a) {
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) {
                a[j][i] = a_over_b.of[j][i] > 0.0;
                b[j][i] = b_over_a.of[j][i] > 0.0;
            }
    }
    void include_zeros(const Heights& a_over_b, const Heights& b_over_a, const LanePair& pair) {
        for (int j = 0; j < 3; ++j) {
            const LaneMask a_inside = ~leans_left(pair.b.edge[j]), b_inside = leans_left(pair.a.edge[j]);
            for (int i = 0; i < 3; ++i) {
                a[j][i] |= (a_over_b.of[j][i] == 0.0) & a_inside;
                b[j][i] |= (b_over_a.of[j][i] == 0.0) & b_inside;
            }
        }
    }
    LaneMask cross(int i, int j) const { return (a[j][i] ^ a[j][next(i)]) & (b[i][j] ^ b[i][next(j)]); }
    // 1 where edge i of a enters b through edge j, -1 where it leaves, else 0.
    Lanes crossing(int i, int j) const {
        const Lanes one = Lanes{} + 1.0;
        const LaneMask crosses = cross(i, j);
        return where(crosses & a[j][next(i)], one) - where(crosses & ~a[j][next(i)], one);
    }
    Lanes contains_a(int i) const { return where(a[0][i] & a[1][i] & a[2][i], Lanes{} + 1.0); }
    Lanes contains_b(int j) const { return where(b[0][j] & b[1][j] & b[2][j], Lanes{} + 1.0); }
};

// How much of a piece of the boundary of the overlap counts in dA/ds: all that is of b.
struct WeightsApart {
    static constexpr bool vary = false;
    static double at_crossing(int, int) { return 1.0; }
};

// The same where edges may coincide, the rule of `overlap_area`: both ends of either within the tolerance of the other's
// line. The piece that they share is of one or of the other, as rounding has it; either counts half. If they run opposite
// ways the triangles lie side by side, and it does not count.
struct WeightsOfCoinciding {
    static constexpr bool vary = true;
    std::array<Lanes, 3> a, b;  // of each edge

    WeightsOfCoinciding(const LanePair& pair, const Heights& a_over_b, const Heights& b_over_a) {
        const Lanes distance = coincidence_tolerance * larger(size_of(pair.a), size_of(pair.b));
        Lanes limit_a[3], limit_b[3];
        LaneMask halved_a[3]{}, halved_b[3]{}, lost_b[3]{};
        for (int i = 0; i < 3; ++i) {
            limit_a[i] = distance * distance * dot(pair.a.edge[i], pair.a.edge[i]);
            limit_b[i] = distance * distance * dot(pair.b.edge[i], pair.b.edge[i]);
        }
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const LaneMask coincide = lies_on(b_over_a.of[i], j, limit_a[i]) | lies_on(a_over_b.of[j], i, limit_b[j]);
                const LaneMask is_parallel = dot(pair.a.edge[i], pair.b.edge[j]) > 0.0;
                halved_a[i] |= coincide & is_parallel;
                halved_b[j] |= coincide & is_parallel;
                lost_b[j] |= coincide & ~is_parallel;
            }
        const Lanes half = Lanes{} + 0.5, one = Lanes{} + 1.0;
        for (int i = 0; i < 3; ++i) {
            a[i] = where(halved_a[i], half);
            b[i] = one - (where(halved_b[i], half) + where(lost_b[i], one));
        }
    }
    Lanes at_crossing(int i, int j) const { return b[j] - a[i]; }

private:
    static Lanes size_of(const TriangleLanes& t) {
        return larger(larger(absolute(t.edge[0].x), absolute(t.edge[0].y)),
                      larger(absolute(t.edge[2].x), absolute(t.edge[2].y)));
    }
    static LaneMask lies_on(const Lanes (&heights)[3], int start, Lanes limit) {  // of the square
        return larger(heights[start] * heights[start], heights[next(start)] * heights[next(start)]) <= limit;
    }
};

struct AreaLanes {
    Lanes twice_area;
    PlaneLanes along;  // sum of the pieces of the boundary of the overlap, each times its weight
};

// The boundary of the overlap goes along edges of a and of b in turn. A piece from p to q of an edge through a point m adds
// cross(p, q) = cross(m, q) - cross(m, p) to twice the area. So a crossing X of an edge of a through m with an edge of b
// through b_j adds -+cross(m - b_j, X), less where a enters b; a corner of a inside b adds cross(m_before - m, a_i), of b
// inside a cross(b_j-1, b_j). X is one point for both edges: an error along nearly parallel edges cancels. The origin is
// b_0, and m is the point of the line that is nearest to it: a larger a brings no larger numbers.
template <class Weights>
AreaLanes area_of(const LanePair& pair, const Heights& b_over_a, const Sides& sides, const Weights& weights) {
    const TriangleLanes &a = pair.a, &b = pair.b;
    const PlaneLanes b_corner[3] = {PlaneLanes{}, b.edge[0], PlaneLanes{} - b.edge[2]};
    PlaneLanes nearest[3];
    for (int i = 0; i < 3; ++i) {
        const Lanes fraction = dot(pair.a_from_b[i], a.edge[i]) / dot(a.edge[i], a.edge[i]);
        nearest[i] = pair.a_from_b[i] - fraction * a.edge[i];
    }
    AreaLanes sum{sides.contains_b(2) * cross(b_corner[1], b_corner[2]), {}};
    for (int i = 0; i < 3; ++i) {
        const PlaneLanes between = nearest[previous(i)] - nearest[i];
        sum.twice_area += sides.contains_a(i) * cross(between, pair.a_from_b[i]);
    }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Lanes weight = sides.crossing(i, j), start = b_over_a.of[i][j], end = b_over_a.of[i][next(j)];
            const Lanes fall = sides.cross(i, j) ? start - end : Lanes{} + 1.0;
            const PlaneLanes crossing = b_corner[j] + (start / fall) * b.edge[j];
            sum.twice_area -= weight * cross(nearest[i] - b_corner[j], crossing);
            sum.along = sum.along + (weight * weights.at_crossing(i, j)) * crossing;
        }
    if constexpr (Weights::vary)  // where they are equal the ends of two edges at a corner cancel
        for (int i = 0; i < 3; ++i) {
            sum.along = sum.along + (sides.contains_a(i) * (weights.a[previous(i)] - weights.a[i])) * pair.a_from_b[i];
            sum.along = sum.along + (sides.contains_b(i) * (weights.b[previous(i)] - weights.b[i])) * b_corner[i];
        }
    return sum;
}

// A register where some heights are within the limit: their signs are found with more care, and coinciding edges count as
// `WeightsOfCoinciding` has it. The columns without such a height give what they give elsewhere, to the last bit.
struct Close {
    Heights a_over_b, b_over_a;
    LaneMask is_separated, is_known;

    template <class HeightOf>
    Close(const LanePair& pair, const Heights& of_a, const Heights& of_b, HeightOf height_of)
        : a_over_b(of_a), b_over_a(of_b) {
        const Certainty certain_of_a = sharpen(pair.b, pair.a, pair.limit, pair.is_given, height_of, a_over_b),
                        certain_of_b = sharpen(pair.a, pair.b, pair.limit, pair.is_given, height_of, b_over_a);
        is_separated = certain_of_a.is_separated | certain_of_b.is_separated;
        is_known = is_separated | (certain_of_a.is_known & certain_of_b.is_known);
    }
    [[nodiscard]] AreaLanes area(const LanePair& pair) const {
        Sides sides(a_over_b, b_over_a);
        sides.include_zeros(a_over_b, b_over_a, pair);
        return area_of(pair, b_over_a, sides, WeightsOfCoinciding(pair, a_over_b, b_over_a));
    }
};

Close look_closely(const LanePair& pair, const Heights& a_over_b, const Heights& b_over_a) {
    const Close close(pair, a_over_b, b_over_a, HeightInDoubles{});
    if (!any(pair.is_given & pair.is_proper & ~close.is_known)) return close;
    return {pair, a_over_b, b_over_a, HeightInTwiceTheDigits{}};
}

// The columns from `first` on that fit in one register.
struct PairHeights {
    LanePair pair;
    Heights a_over_b, b_over_a;
    LaneMask is_separated, is_clear;  // by the limit: clear of it are those with no height within it, and those apart

    PairHeights(const TriangleBatch& batch, int first)
        : pair(batch, first), a_over_b(pair.b, pair.a), b_over_a(pair.a, pair.b) {
        is_separated = a_over_b.separate(pair.limit) | b_over_a.separate(pair.limit);
        is_clear = is_separated | ((a_over_b.least() > pair.limit) & (b_over_a.least() > pair.limit));
    }
};

// Bit k: pair k. Those in neither share nothing.
struct Columns {
    std::uint64_t clear = 0;      // they overlap, and no height is within the limit
    std::uint64_t close = 0;      // to be looked at closely
    std::uint64_t undecided = 0;  // thin, tiny or huge
};

void sort_out(const TriangleBatch& batch, int first, Columns& columns) {
    const PairHeights heights(batch, first);
    const LanePair& pair = heights.pair;
    LaneMask is_separated = heights.is_separated;
    if (any(~heights.is_clear & pair.is_proper))
        is_separated |= LowestLine(pair.a, pair.b, heights.a_over_b, heights.b_over_a).separates(pair.limit, pair.is_given);
    const LaneMask is_left = pair.is_proper & ~is_separated;
    columns.clear |= std::uint64_t{bits_of(is_left & heights.is_clear)} << first;
    columns.close |= std::uint64_t{bits_of(is_left & ~heights.is_clear)} << first;
    columns.undecided |= std::uint64_t{bits_of(~pair.is_proper)} << first;
}

struct Shared {
    AreaLanes area;
    LaneMask is_separated, is_known;
};

Shared shared_by(const TriangleBatch& batch, int first) {
    const PairHeights heights(batch, first);
    const auto& [pair, a_over_b, b_over_a, is_separated, is_clear] = heights;
    if (any(~is_clear)) {
        const Close close = look_closely(pair, a_over_b, b_over_a);
        return {close.area(pair), close.is_separated, close.is_known};
    }
    return {area_of(pair, b_over_a, Sides(a_over_b, b_over_a), WeightsApart{}), is_separated, is_clear};
}

void copy_column(const TriangleBatch& from, int column, TriangleBatch& to, int k) {
    for (auto rows : {&TriangleBatch::x_a, &TriangleBatch::y_a, &TriangleBatch::x_b, &TriangleBatch::y_b})
        for (int i = 0; i < 3; ++i) (to.*rows)[i][k] = (from.*rows)[i][column];
    to.rounded_shift[k] = from.rounded_shift[column];
}

double twice_area_of(const std::array<PlaneVector<3>, 3>& face) {
    return geometry::cross(PlaneVector<3>(face[1] - face[0]), PlaneVector<3>(face[2] - face[0]));
}

// Puts a pair into column k, the smaller face as b; whether that is face 1. Both are seen from a corner of b if there is a
// shift to be added: what is large and common cancels before anything is rounded.
bool put(const TrianglePair& pair, int k, TriangleBatch& batch) {
    const bool is_swapped = twice_area_of(pair.face_2) > twice_area_of(pair.face_1);
    const auto &a = is_swapped ? pair.face_2 : pair.face_1, &b = is_swapped ? pair.face_1 : pair.face_2;
    const PlaneVector<3> shift_of_a = is_swapped ? pair.shift : -pair.shift;
    const double size = pair.shift.cwiseAbs().maxCoeff();
    const PlaneVector<3> origin = size == 0.0 ? PlaneVector<3>::Zero() : b[0];
    for (int i = 0; i < 3; ++i) {
        batch.x_a[i][k] = (a[i].x() - origin.x()) + shift_of_a.x();
        batch.y_a[i][k] = (a[i].y() - origin.y()) + shift_of_a.y();
        batch.x_b[i][k] = b[i].x() - origin.x();
        batch.y_b[i][k] = b[i].y() - origin.y();
    }
    batch.rounded_shift[k] = size;
    return is_swapped;
}

OverlapArea<3> taken(const AreaBatch& result, int k, bool is_swapped) {
    const PlaneVector<3> derivative(result.area_gradient[0][k], result.area_gradient[1][k]);
    return {result.area[k], is_swapped ? PlaneVector<3>(-derivative) : derivative};
}

// At most TriangleBatch::size pairs. Columns that fill up a register repeat the first one.
void share(std::span<const TrianglePair> pairs, std::span<OverlapArea<3>> areas, DecisionCounts& counts) {
    TriangleBatch batch;
    std::array<bool, TriangleBatch::size> is_swapped;
    const int n = static_cast<int>(pairs.size());
    int n_put = 0;
    do {
        is_swapped[n_put] = put(pairs[n_put < n ? n_put : 0], n_put, batch);
    } while (++n_put < n || n_put % lane_count != 0);
    const AreaBatch result = overlap_areas(batch, n);
    for (int k = 0; k < n; ++k) {
        if (result.undecided >> k & 1) {
            areas[k] = counted_overlap_area(pairs[k].face_1, pairs[k].face_2, pairs[k].shift, counts);
        } else {
            areas[k] = taken(result, k, is_swapped[k]);
            ++counts.by_doubles;
        }
    }
}

}  // namespace

DecisionCounts& DecisionCounts::operator+=(const DecisionCounts& other) {
    by_doubles += other.by_doubles;
    by_scalar_path += other.by_scalar_path;
    by_exact_arithmetic += other.by_exact_arithmetic;
    return *this;
}

// Most candidates share nothing, and most of these are told by one line. The others are moved together, those to be
// looked at closely after the clear ones.
AreaBatch overlap_areas(const TriangleBatch& triangles, int n) {
    Columns columns;
    for (int first = 0; first < n; first += lane_count) sort_out(triangles, first, columns);

    AreaBatch result{};
    result.undecided = columns.undecided;
    TriangleBatch left;
    std::array<int, TriangleBatch::size> column;
    int n_left = 0;
    for (const std::uint64_t some : {columns.clear, columns.close})
        for (std::uint64_t rest = some; rest != 0; rest &= rest - 1) {
            column[n_left] = std::countr_zero(rest);
            copy_column(triangles, column[n_left], left, n_left);
            ++n_left;
        }
    for (int k = n_left; k % lane_count != 0; ++k) copy_column(left, 0, left, k);
    for (int first = 0; first < n_left; first += lane_count) {
        const Shared shared = shared_by(left, first);
        const int n_here = std::min(lane_count, n_left - first);
        for (int k = 0; k < n_here; ++k) {
            const int to = column[first + k];
            if (!shared.is_known[k]) result.undecided |= std::uint64_t{1} << to;
            if (!shared.is_known[k] || shared.is_separated[k]) continue;
            result.area[to] = std::max(0.5 * shared.area.twice_area[k], std::numeric_limits<double>::min());
            result.area_gradient[0][to] = shared.area.along.y[k];
            result.area_gradient[1][to] = -shared.area.along.x[k];
        }
    }
    return result;
}

DecisionCounts overlap_areas(std::span<const TrianglePair> pairs, std::span<OverlapArea<3>> areas) {
    if (pairs.size() != areas.size())
        throw BadInput("shared areas: `areas` has " + std::to_string(areas.size()) + " entries for " +
                       std::to_string(pairs.size()) + " pairs. Give as many.");
    DecisionCounts counts;
    for (std::size_t first = 0; first < pairs.size(); first += TriangleBatch::size) {
        const std::size_t n = std::min<std::size_t>(TriangleBatch::size, pairs.size() - first);
        share(pairs.subspan(first, n), areas.subspan(first, n), counts);
    }
    return counts;
}

}  // namespace abut::geometry
