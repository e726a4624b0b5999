#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_energy.hpp"

namespace abut::geometry::lanes {

inline constexpr double tie_3d = 1e-12;   // of the length of an edge: a corner this near to its line is on it
inline constexpr double no_area = 4e-15;  // of the product of the lengths of two edges

/// Both triangles seen along their common normal. In the frame of the pair n_1 = e_3.
template <class T>
struct SeenPair {
    using Plane = LaneVector<T, 2>;
    using Space = LaneVector<T, 3>;

    SeenPair(const LaneCorners<T, 3>& z, const T& offset) : edge_b(z.at[4] - z.at[3]), edge_c(z.at[5] - z.at[3]) {
        const Space area = cross(edge_b, edge_c);
        over_twice_area_2 = T(1.0) / norm(area);
        normal_2 = over_twice_area_2 * (area - (dot(area, edge_b) / dot(edge_b, edge_b)) * edge_b);  // as in LaneFrame
        facing = normal_2.c[2];
        const Space between{-normal_2.c[0], -normal_2.c[1], T(1.0) - normal_2.c[2]};
        over_difference = T(1.0) / norm(between);
        common = over_difference * between;
        // n is never far from e_3
        const T a = T(-1.0) / (T(1.0) + common.c[2]), b = common.c[0] * common.c[1] * a;
        tangent[0] = {T(1.0) + common.c[0] * common.c[0] * a, b, -common.c[0]};
        tangent[1] = {b, T(1.0) + common.c[1] * common.c[1] * a, -common.c[1]};
        for (int v = 0; v < 6; ++v) {
            plane[v] = {dot(tangent[0], z.at[v]), dot(tangent[1], z.at[v])};
            height[v] = dot(common, z.at[v]);
        }
        // n_1 and n_2 are each other's mirror images along n, n . n_1 = |n_1 - n_2|/2: the faces have opposite slopes
        const T steepness = T(2.0) * over_difference;
        slope = {steepness * tangent[0].c[2], steepness * tangent[1].c[2]};
        gap_slope = T(2.0) * slope;
        gap_at_0 = height[3] - height[0] - dot(slope, plane[3] + plane[0]) + offset;
    }
    [[nodiscard]] T gap(const Plane& q) const { return gap_at_0 + dot(gap_slope, q); }
    /// Squares of two edges of a face, of the smaller one.
    [[nodiscard]] T double_least_edges() const {
        T squares[2];
        for (int face = 0; face < 2; ++face) {
            const Plane b = plane[3 * face + 1] - plane[3 * face], c = plane[3 * face + 2] - plane[3 * face];
            squares[face] = dot(b, b) + dot(c, c);
        }
        return lower(squares[0], squares[1]);
    }

    Space edge_b, edge_c;  // of face 2
    Space normal_2;
    T over_twice_area_2;
    T facing;
    Space common;       // n
    T over_difference;  // 1/|n_1 - n_2|
    Space tangent[2];   // with n right-handed
    Plane plane[6];
    T height[6];  // along n
    Plane slope;  // of the height of face 2 over the plane
    Plane gap_slope;
    T gap_at_0;
};

/// The part of an edge of one face that bounds the overlap: between `from` and `to`, which are at `low` and `high` of the
/// edge.
template <class T>
struct EdgePart {
    EdgePart() = default;
    EdgePart(const LaneVector<T, 2>& start, const LaneVector<T, 2>& end)
        : from(start), to(end), low(0.0), high(1.0), is_outside(T(0.0) > T(1.0)) {}

    /// Cuts by a line: the corners of the edge are at `start` and `end` from it, times its length, inside where that is
    /// > 0; the line crosses the edge at the point `crossing`, at `at` of the edge. Not where `is_on_line`.
    void cut(const FlagsOf<T>& start_inside, const FlagsOf<T>& end_inside, const FlagsOf<T>& is_on_line,
             const LaneVector<T, 2>& crossing, const T& at) {
        const FlagsOf<T> enters = without(without(end_inside, start_inside), is_on_line) & (at > low);
        const FlagsOf<T> leaves = without(without(start_inside, end_inside), is_on_line) & (at < high);
        is_outside = is_outside | without(negated(start_inside | end_inside), is_on_line);
        low = select(enters, at, low);
        from = select(enters, crossing, from);
        high = select(leaves, at, high);
        to = select(leaves, crossing, to);
    }
    void close() { is_outside = is_outside | negated(high > low); }

    LaneVector<T, 2> from, to;
    T low, high;
    FlagsOf<T> is_outside;
    T weight = T(1.0);  // an edge of both faces: half each
    T gap_from, gap_to;
};

/// Measures of an outline, before g < 0 is asked for.
template <class T>
struct OutlineMeasures {
    LaneVector<T, 2> middle;  // a mean point of P
    T squared_size;           // of the square of its perimeter, and more
    T overlap;                // |P|
    T gap;                    // least over P; infinite without it
};

/// Position from 0 to 1 at which a line that is a at the start and b at the end is 0.
template <class T>
T root_between(const T& a, const T& b, const FlagsOf<T>& crosses) {
    return select(crosses, a, T(0.0)) / select(crosses, a - b, T(1.0));
}

/// Sets the gaps at both ends of each part. `Outline`: `part`, and their number `n`.
template <class T, class Outline>
OutlineMeasures<T> measure(const SeenPair<T>& seen, Outline& outline) {
    OutlineMeasures<T> of{no_vector<T, 2>(), T(0.0), T(0.0), T(__builtin_inf())};
    T count(0.0);
    for (int k = 0; k < outline.n; ++k) {
        EdgePart<T>& part = outline.part[k];
        part.gap_from = seen.gap(part.from);
        part.gap_to = seen.gap(part.to);
        const T counts = select(part.is_outside, T(0.0), T(1.0));
        of.middle += counts * (part.from + part.to);
        count = count + counts + counts;
        const LaneVector<T, 2> along = part.to - part.from;
        of.squared_size = of.squared_size + T(6.0) * counts * dot(along, along);
        of.gap = select(part.is_outside, of.gap, lower(of.gap, lower(part.gap_from, part.gap_to)));
    }
    of.middle = (T(1.0) / higher(count, T(1.0))) * of.middle;
    for (int k = 0; k < outline.n; ++k) {
        const EdgePart<T>& part = outline.part[k];
        const T twice_area = part.weight * cross(part.from - of.middle, part.to - of.middle);
        of.overlap = of.overlap + select(part.is_outside, T(0.0), T(0.5) * twice_area);
    }
    return of;
}

/// Cuts away what has g >= 0.
template <class T, class Outline>
void keep_negative_gap(Outline& outline) {
    for (int k = 0; k < outline.n; ++k) {
        EdgePart<T>& part = outline.part[k];
        const FlagsOf<T> from_counts = part.gap_from < T(0.0), to_counts = part.gap_to < T(0.0);
        part.is_outside = part.is_outside | negated(from_counts | to_counts);
        const T at = root_between<T>(part.gap_from, part.gap_to, from_counts ^ to_counts);
        const LaneVector<T, 2> root = part.from + at * (part.to - part.from);
        const T at_root = part.low + at * (part.high - part.low);
        const FlagsOf<T> moves_from = without(to_counts, from_counts), moves_to = without(from_counts, to_counts);
        part.from = select<T, 2>(moves_from, root, part.from);
        part.to = select<T, 2>(moves_to, root, part.to);
        part.low = select(moves_from, at_root, part.low);
        part.high = select(moves_to, at_root, part.high);
        part.gap_from = select(from_counts, part.gap_from, T(0.0));
        part.gap_to = select(to_counts, part.gap_to, T(0.0));
    }
}

/// The outline of the overlap P, without a polygon: the parts of the six edges, counter-clockwise. Where two edges cross is
/// computed once for both, so that the outline closes where they are nearly parallel. Where corners lie on each other
/// besides, it may not.
template <class T>
struct Outline {
    using Plane = LaneVector<T, 2>;
    static constexpr int n = 6;
    static constexpr int corners[n][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 5}, {5, 4}, {4, 3}};  // face 2 runs clockwise

    explicit Outline(const SeenPair<T>& seen) {
        Plane corner[2][3], edge[2][3];
        T squared_length[2][3];
        for (int face = 0; face < 2; ++face)
            for (int i = 0; i < 3; ++i) {
                const Plane &start = seen.plane[corners[3 * face + i][0]], &end = seen.plane[corners[3 * face + i][1]];
                corner[face][i] = start;
                edge[face][i] = end - start;
                squared_length[face][i] = dot(edge[face][i], edge[face][i]);
                part[3 * face + i] = {start, end};
            }
        // beside[face][line][i]: corner i of a face from a line of the other one, > 0 inside
        T beside[2][3][4];
        FlagsOf<T> on_line[2][3][4], inside[2][3][4];
        for (int face = 0; face < 2; ++face)
            for (int line = 0; line < 3; ++line) {
                const T tolerance = T(tie_3d) * squared_length[1 - face][line];
                for (int i = 0; i < 3; ++i) {
                    beside[face][line][i] = cross(edge[1 - face][line], corner[face][i] - corner[1 - face][line]);
                    on_line[face][line][i] = magnitude(beside[face][line][i]) <= tolerance;
                    inside[face][line][i] = beside[face][line][i] > T(0.0);
                }
                beside[face][line][3] = beside[face][line][0];
                on_line[face][line][3] = on_line[face][line][0];
                inside[face][line][3] = inside[face][line][0];
            }
        T over_squared_length[3];
        for (int j = 0; j < 3; ++j) over_squared_length[j] = T(1.0) / squared_length[1][j];
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                const FlagsOf<T> is_shared =
                    (on_line[0][j][i] & on_line[0][j][i + 1]) | (on_line[1][i][j] & on_line[1][i][j + 1]);
                // where the edges cross: on edge i of face 1 or, where line j does not meet it, where line i meets edge j
                const FlagsOf<T> crosses_1 = inside[0][j][i] ^ inside[0][j][i + 1],
                                 crosses_2 = inside[1][i][j] ^ inside[1][i][j + 1];
                const T from = select(crosses_1, beside[0][j][i], beside[1][i][j]);
                const T to = select(crosses_1, beside[0][j][i + 1], beside[1][i][j + 1]);
                const T at = root_between<T>(from, to, crosses_1 | crosses_2);
                const Plane crossing = select<T, 2>(crosses_1, corner[0][i], corner[1][j]) +
                                       at * select<T, 2>(crosses_1, edge[0][i], edge[1][j]);
                const T at_2 = select(crosses_1, over_squared_length[j] * dot(crossing - corner[1][j], edge[1][j]), at);
                EdgePart<T>&part_1 = part[i], &part_2 = part[3 + j];
                part_1.cut(inside[0][j][i], inside[0][j][i + 1], is_shared, crossing, at);
                part_2.cut(inside[1][i][j], inside[1][i][j + 1], is_shared, crossing, at_2);
                part_1.weight = select(is_shared, T(0.5), part_1.weight);
                part_2.weight = select(is_shared, T(0.5), part_2.weight);
            }
        close(squared_length);
    }
    [[nodiscard]] int start(int k) const { return corners[k][0]; }
    [[nodiscard]] int end(int k) const { return corners[k][1]; }

    EdgePart<T> part[n];
    FlagsOf<T> is_open;

private:
    void close(const T (&squared_length)[2][3]) {
        Plane gap = no_vector<T, 2>();
        T size(0.0);
        for (int k = 0; k < n; ++k) {
            part[k].close();
            gap += select(part[k].is_outside, T(0.0), part[k].weight) * (part[k].to - part[k].from);
            size = size + squared_length[k / 3][k % 3];
        }
        is_open = dot(gap, gap) > T(1e-24) * size;
    }
};

/// Integrals over the part of the overlap where g < 0, of g and of g (q - origin). The line g = 0 adds nothing, since the
/// origin lies on it wherever it bounds P.
template <class T>
struct Moments {
    using Plane = LaneVector<T, 2>;

    template <class Outline>
    Moments(const SeenPair<T>& seen, const OutlineMeasures<T>& measures, const Outline& outline)
        : gap_slope(seen.gap_slope) {
        const T at_middle = seen.gap(measures.middle), squared_slope = dot(gap_slope, gap_slope);
        const FlagsOf<T> may_cross = at_middle * at_middle < measures.squared_size * squared_slope;
        const T back = at_middle / select(may_cross, squared_slope, T(1.0));
        origin = select<T, 2>(may_cross, measures.middle - back * gap_slope, measures.middle);
        gap_at_origin = select(may_cross, T(0.0), at_middle);
        area = gap = T(0.0);
        first = no_vector<T, 2>();
        for (int k = 0; k < outline.n; ++k) {
            const EdgePart<T>& part = outline.part[k];
            const Plane r_0 = part.from - origin, r_1 = part.to - origin;
            const T of_part = select(part.is_outside, T(0.0), T(0.5) * part.weight * cross(r_0, r_1));
            const T sum = gap_at_origin + part.gap_from + part.gap_to;
            area = area + of_part;
            gap = gap + T(1.0 / 3.0) * of_part * sum;
            const T twelfth = T(1.0 / 12.0) * of_part;
            first += (twelfth * (sum + part.gap_from)) * r_0 + (twelfth * (sum + part.gap_to)) * r_1;
        }
    }
    [[nodiscard]] T gap_squared() const { return gap_at_origin * gap + dot(gap_slope, first); }

    Plane gap_slope;
    Plane origin;
    T gap_at_origin;
    T area, gap;
    Plane first;
};

/// dW0/d of heights and of positions in the plane, of each corner; W = chi W0.
template <class T>
struct PlaneGradient {
    using Plane = LaneVector<T, 2>;

    template <class Outline>
    PlaneGradient(const SeenPair<T>& seen, const Outline& outline, const Moments<T>& moments, const T& stiffness) {
        add_inside(seen, moments, stiffness);
        for (int k = 0; k < outline.n; ++k)
            add_edge(outline.part[k], stiffness, plane[outline.start(k)], plane[outline.end(k)]);
    }

    T height[6];
    Plane plane[6];
    T pressure[6];  // int k |g| N_v

private:
    /// The gradient of g over the inside, I_v = k int g N_v.
    void add_inside(const SeenPair<T>& seen, const Moments<T>& moments, const T& stiffness) {
        for (int face = 0; face < 2; ++face) {
            const int a = 3 * face, b = a + 1, c = a + 2;
            const Plane ab = seen.plane[b] - seen.plane[a], ac = seen.plane[c] - seen.plane[a];
            const T scale = stiffness / cross(ab, ac);
            const Plane all = moments.gap * (moments.origin - seen.plane[a]) + moments.first;
            T integral[3];
            integral[1] = scale * cross(all, ac);
            integral[2] = scale * cross(ab, all);
            integral[0] = stiffness * moments.gap - integral[1] - integral[2];
            const T sign(face == 0 ? -1.0 : 1.0);
            for (int i = 0; i < 3; ++i) {
                pressure[a + i] = -integral[i];
                height[a + i] = sign * integral[i];
                // the heights of the faces have the slopes -slope and slope
                plane[a + i] = -integral[i] * seen.slope;
            }
        }
    }

    /// The gradient of the motion of an edge of the overlap, a part of the edge of a face between two corners.
    static void add_edge(const EdgePart<T>& edge, const T& stiffness, Plane& start, Plane& end) {
        const Plane along = edge.to - edge.from, outward{along.c[1], -along.c[0]};
        const T &g_0 = edge.gap_from, &g_1 = edge.gap_to;
        const T factor = select(edge.is_outside, T(0.0), T(0.5) * edge.weight * stiffness);
        const T squares = factor * T(1.0 / 3.0) * (g_0 * g_0 + g_0 * g_1 + g_1 * g_1);
        const T rising = factor * T(1.0 / 12.0) * (g_0 * g_0 + T(2.0) * g_0 * g_1 + T(3.0) * g_1 * g_1);
        const T of_end = edge.low * squares + (edge.high - edge.low) * rising;
        start += (squares - of_end) * outward;
        end += of_end * outward;
    }
};

/// dW/dz from dW0 in the plane: along n and in the plane, what turns n, and what turns face 2 against face 1. What would
/// turn face 1 is left out: in the frame of the pair it does not turn.
template <class T>
LaneCorners<T, 3> in_frame(const SeenPair<T>& seen, const PlaneGradient<T>& plane, const T& energy,
                           const LaneFacing<T>& weight) {
    LaneCorners<T, 3> gradient;
    LaneVector<T, 2> turn = no_vector<T, 2>();
    for (int v = 0; v < 6; ++v) {
        gradient.at[v] = weight.chi * (plane.plane[v].c[0] * seen.tangent[0] + plane.plane[v].c[1] * seen.tangent[1] +
                                       plane.height[v] * seen.common);
        turn += plane.height[v] * seen.plane[v] - seen.height[v] * plane.plane[v];
    }
    LaneVector<T, 3> of_normal =
        (-weight.chi * seen.over_difference) * (turn.c[0] * seen.tangent[0] + turn.c[1] * seen.tangent[1]);
    of_normal.c[2] = of_normal.c[2] + energy * weight.slope;
    const LaneVector<T, 3> of_area = seen.over_twice_area_2 * (of_normal - dot(seen.normal_2, of_normal) * seen.normal_2);
    const LaneVector<T, 3> of_b = cross(seen.edge_c, of_area), of_c = cross(of_area, seen.edge_b);
    gradient.at[3] -= of_b + of_c;
    gradient.at[4] += of_b;
    gradient.at[5] += of_c;
    return gradient;
}

template <class T, class Outline>
LaneEnergy<T, 3> energy_in(Outline& outline, const SeenPair<T>& seen, const LaneLaw<T>& law) {
    const OutlineMeasures<T> measures = measure(seen, outline);
    const T least_area = T(no_area) * seen.double_least_edges();
    LaneEnergy<T, 3> result;
    result.facing = seen.facing;
    result.common = seen.common;
    result.overlap = select(measures.overlap > least_area, measures.overlap, T(0.0));
    result.view_gap = result.gap = measures.gap;
    keep_negative_gap<T>(outline);
    const Moments<T> moments(seen, measures, outline);
    const T integral = T(0.5) * law.stiffness * moments.gap_squared();
    const T energy = select(integral < T(0.0), T(0.0), integral);  // rounding may take it below
    const LaneFacing<T> weight(seen.facing, law);
    const PlaneGradient<T> plane(seen, outline, moments, law.stiffness);
    result.energy = weight.chi * energy;
    result.area = moments.area;
    result.gradient = in_frame(seen, plane, energy, weight);
    for (int v = 0; v < 6; ++v) result.pressure[v] = weight.chi * plane.pressure[v];
    keep_where<T, 3>((seen.facing < law.none) & (T(2.0) * moments.area > least_area), result);
    return result;
}

/// `energy_of` by a polygon, whose outline always closes, at several times the cost.
LaneEnergy<double, 3> energy_by_polygon(const LaneCorners<double, 3>& z, const LaneLaw<double>& law);

template <class T>
LaneEnergy<T, 3> energy_of(const LaneCorners<T, 3>& z, const LaneLaw<T>& law) {
    const SeenPair<T> seen(z, law.offset);
    Outline<T> outline(seen);
    LaneEnergy<T, 3> result = energy_in(outline, seen, law);
    for (int i = 0; i < LanesOf<T>::count; ++i)
        if (lane(outline.is_open, i)) set_lane(result, i, energy_by_polygon(lane(z, i), lane(law, i)));
    return result;
}

}  // namespace abut::geometry::lanes
