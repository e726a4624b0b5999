#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_energy.hpp"

namespace abut::geometry::lanes {

inline constexpr double tie_2d =
    1e-12;  // of the lengths: ends this near to each other share what the end of the overlap does

/// The faces over the line along which both are seen: xi falls from corner 0 to 1 of face 1 and rises from 2 to 3 of face 2.
template <class T>
struct Strip {
    explicit Strip(const LaneCorners<T, 2>& z) : edge{z.at[1] - z.at[0], z.at[3] - z.at[2]} {
        for (int face = 0; face < 2; ++face) {
            length[face] = norm(edge[face]);
            slope[face] = edge[face].c[1] / edge[face].c[0];
        }
        facing = dot(edge[0], edge[1]) / (length[0] * length[1]);
        high = lower(z.at[0].c[0], z.at[3].c[0]);
        low = higher(z.at[1].c[0], z.at[2].c[0]);
        const T tolerance = T(tie_2d) * (length[0] + length[1]);
        high_of_1 = share(z.at[0].c[0] < z.at[3].c[0], z.at[0].c[0] - z.at[3].c[0], tolerance);
        low_of_1 = share(z.at[1].c[0] > z.at[2].c[0], z.at[1].c[0] - z.at[2].c[0], tolerance);
        for (int face = 0; face < 2; ++face) start[face] = z.at[2 * face];
    }
    [[nodiscard]] T height(int face, const T& xi) const { return start[face].c[1] + slope[face] * (xi - start[face].c[0]); }
    [[nodiscard]] T gap(const T& xi) const { return height(1, xi) - height(0, xi); }
    /// Linear shape function of the second corner of a face.
    [[nodiscard]] T shape(int face, const T& xi) const { return (xi - start[face].c[0]) / edge[face].c[0]; }

    LaneVector<T, 2> edge[2];  // second corner less first
    T length[2];
    T slope[2];  // of eta over xi; meaningless where the faces do not look at each other
    T facing;
    T high, low;            // ends of the overlap
    T high_of_1, low_of_1;  // share of the corner of face 1 in the end; the rest is that of the corner of face 2
    LaneVector<T, 2> start[2];

private:
    static T share(const FlagsOf<T>& is_end, const T& apart, const T& tolerance) {
        return select(magnitude(apart) <= tolerance, T(0.5), select(is_end, T(1.0), T(0.0)));
    }
};

template <class T>
void add_facing(const Strip<T>& strip, const T& factor, LaneCorners<T, 2>& gradient) {
    for (int face = 0; face < 2; ++face) {
        const T own = strip.length[face], other = strip.length[1 - face];
        const LaneVector<T, 2> of_edge =
            factor * ((T(1.0) / (own * other)) * strip.edge[1 - face] - (strip.facing / (own * own)) * strip.edge[face]);
        gradient.at[2 * face] -= of_edge;
        gradient.at[2 * face + 1] += of_edge;
    }
}

template <class T>
LaneEnergy<T, 2> energy_of(const LaneCorners<T, 2>& z, const LaneLaw<T>& law) {
    const Strip<T> strip(z);
    LaneEnergy<T, 2> result;
    result.facing = strip.facing;
    result.common = {T(0.0), T(1.0)};
    const FlagsOf<T> overlaps = strip.high > strip.low;
    result.overlap = select(overlaps, strip.high - strip.low, T(0.0));
    const T gap_low = strip.gap(strip.low) + law.offset, gap_high = strip.gap(strip.high) + law.offset;
    result.view_gap = lower(gap_low, gap_high);

    // used where the signs differ; rounding may take it past an end
    const FlagsOf<T> low_acts = gap_low < T(0.0), high_acts = gap_high < T(0.0);
    const T along = gap_low / select(low_acts ^ high_acts, gap_low - gap_high, T(1.0));
    const T root = lower(higher(strip.low + (strip.high - strip.low) * along, strip.low), strip.high);
    const T p = select(low_acts, strip.low, root), q = select(high_acts, strip.high, root), m = T(0.5) * (p + q);
    const T g_p = lower(gap_low, T(0.0)), g_q = lower(gap_high, T(0.0)), g_m = T(0.5) * (g_p + g_q);
    const T energy = law.stiffness * (q - p) / T(12.0) * (g_p * g_p + T(4.0) * g_m * g_m + g_q * g_q);
    const LaneFacing<T> weight(strip.facing, law);
    result.energy = weight.chi * energy;
    result.area = q - p;
    result.gap = lower(g_p, g_q);

    const T scale = weight.chi * law.stiffness * (q - p) / T(6.0);
    const T all = scale * (g_p + T(4.0) * g_m + g_q);
    for (int face = 0; face < 2; ++face) {
        const T of_second =
            scale * (g_p * strip.shape(face, p) + T(4.0) * g_m * strip.shape(face, m) + g_q * strip.shape(face, q));
        const T integral[2] = {all - of_second, of_second};
        const T sign(face == 0 ? -1.0 : 1.0);
        for (int i = 0; i < 2; ++i) {
            result.pressure[2 * face + i] = -integral[i];
            const T along_normal = sign * integral[i];
            result.gradient.at[2 * face + i] = {-strip.slope[face] * along_normal, along_normal};
        }
    }
    const T pull_high = weight.chi * T(0.5) * law.stiffness * g_q * g_q;
    const T pull_low = weight.chi * T(-0.5) * law.stiffness * g_p * g_p;
    const auto add = [&](int corner, const T& pull) {
        result.gradient.at[corner].c[0] = result.gradient.at[corner].c[0] + pull;
    };
    add(0, strip.high_of_1 * pull_high);
    add(3, (T(1.0) - strip.high_of_1) * pull_high);
    add(1, strip.low_of_1 * pull_low);
    add(2, (T(1.0) - strip.low_of_1) * pull_low);
    add_facing(strip, energy * weight.slope, result.gradient);
    keep_where<T, 2>((strip.facing < law.none) & overlaps & (low_acts | high_acts), result);
    return result;
}

}  // namespace abut::geometry::lanes
