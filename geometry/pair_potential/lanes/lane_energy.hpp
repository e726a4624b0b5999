#pragma once
// Private to the layer; see lanes.hpp.
#include "abut/geometry/pair_potential/lanes/lane_frame.hpp"

namespace abut::geometry::lanes {

/// W of a pair in coordinates z in which nothing but the shape of the pair is left (LaneFrame), and its gradient there.
template <class T, int Dim>
struct LaneEnergy {
    T energy;
    T gap;                         // the least g over the part of the overlap where g < 0, 0 without one
    T area;                        // of that part
    LaneCorners<T, Dim> gradient;  // dW/dz
    T pressure[2 * Dim];           // int k |g| N_v
    LaneVector<T, Dim> common;     // n in the frame
    T facing;                      // n_1 . n_2
    T overlap;                     // |P|
    T view_gap;                    // the least g over P; meaningless where P is empty
};

/// chi and dchi/dc.
template <class T>
struct LaneFacing {
    LaneFacing(const T& cosine, const LaneLaw<T>& law) {
        const T steepness = T(1.0) / (law.none - law.full);
        const T y = lower(higher((law.none - cosine) * steepness, T(0.0)), T(1.0));
        chi = y * y * (T(3.0) - T(2.0) * y);
        slope = T(-6.0) * y * (T(1.0) - y) * steepness;
    }
    T chi, slope;
};

/// One lane of all.
template <class T, int Dim>
LaneCorners<double, Dim> lane(const LaneCorners<T, Dim>& x, int i) {
    LaneCorners<double, Dim> of;
    for (int v = 0; v < 2 * Dim; ++v)
        for (int d = 0; d < Dim; ++d) of.at[v].c[d] = lane(x.at[v].c[d], i);
    return of;
}
template <class T>
LaneLaw<double> lane(const LaneLaw<T>& law, int i) {
    return {lane(law.stiffness, i),
            {lane(law.length[0], i), lane(law.length[1], i)},
            lane(law.full, i),
            lane(law.none, i),
            lane(law.offset, i)};
}
template <class T, int Dim>
void set_lane(LaneEnergy<T, Dim>& all, int i, const LaneEnergy<double, Dim>& of) {
    set_lane(all.energy, i, of.energy);
    set_lane(all.gap, i, of.gap);
    set_lane(all.area, i, of.area);
    for (int v = 0; v < 2 * Dim; ++v) {
        for (int d = 0; d < Dim; ++d) set_lane(all.gradient.at[v].c[d], i, of.gradient.at[v].c[d]);
        set_lane(all.pressure[v], i, of.pressure[v]);
    }
    for (int d = 0; d < Dim; ++d) set_lane(all.common.c[d], i, of.common.c[d]);
    set_lane(all.facing, i, of.facing);
    set_lane(all.overlap, i, of.overlap);
    set_lane(all.view_gap, i, of.view_gap);
}

/// Sets all to 0 where W does not act.
template <class T, int Dim>
void keep_where(const FlagsOf<T>& acts, LaneEnergy<T, Dim>& of) {
    const auto keep = [&](T& value) { value = select(acts, value, T(0.0)); };
    keep(of.energy);
    keep(of.gap);
    keep(of.area);
    for (int v = 0; v < 2 * Dim; ++v) {
        for (int d = 0; d < Dim; ++d) keep(of.gradient.at[v].c[d]);
        keep(of.pressure[v]);
    }
}

}  // namespace abut::geometry::lanes
