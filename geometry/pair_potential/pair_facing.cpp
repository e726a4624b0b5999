#include "abut/geometry/pair_potential/pair_facing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "abut/geometry/pair_potential/pair_normal.hpp"

namespace abut::geometry {
namespace {

/// Bound of the sine of the turn of a normal per length r by which corners move beside a translation: an edge changes by
/// up to 2 r.
double turn_per_motion(const Vector<2>* x) { return 2.0 / (x[1] - x[0]).norm(); }
/// So do the longest edge L and the height H over it, and their product by 2 r (L + H) + 4 r^2 at most. The square is below
/// a quarter of the rest where r is as `reach_turned_away` has it.
double turn_per_motion(const Vector<3>* x) {
    const Vector<3> u = x[1] - x[0], w = x[2] - x[0];
    const double longest = std::sqrt(std::max({u.squaredNorm(), w.squaredNorm(), (w - u).squaredNorm()}));
    return 2.5 * (longest / u.cross(w).norm() + 1.0 / longest);
}

}  // namespace

template <int Dim>
double pair_facing(const PairCorners<Dim>& corners) {
    return facing_cosine(corners);
}

/// The sum of two angles is below the angle whose sine is the sum of their sines.
template <int Dim>
double reach_turned_away(const PairCorners<Dim>& corners, double none) {
    constexpr double rounding = 1e-6;  // [rad]
    const double left = std::acos(none) - std::acos(std::min(facing_cosine(corners), 1.0)) - rounding;
    if (!(left > 0.0)) return 0.0;
    return std::sin(std::min(left, 0.5 * std::numbers::pi)) /
           (turn_per_motion(&corners[0]) + turn_per_motion(&corners[Dim]));
}

template double pair_facing(const PairCorners<2>&);
template double pair_facing(const PairCorners<3>&);
template double reach_turned_away(const PairCorners<2>&, double);
template double reach_turned_away(const PairCorners<3>&, double);

}  // namespace abut::geometry
