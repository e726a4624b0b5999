#pragma once
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::geometry {

/// PairState::facing alone: n_1 . n_2.
template <int Dim>
[[nodiscard]] double pair_facing(const PairCorners<Dim>& corners);

/// How far corners may move beside a translation of each face before n_1 . n_2 can fall below `none` [m]; 0 where it is
/// below, or so near that rounding decides.
template <int Dim>
[[nodiscard]] double reach_turned_away(const PairCorners<Dim>& corners, double none);

}  // namespace abut::geometry
