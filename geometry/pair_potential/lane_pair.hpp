#pragma once
// Private to the layer. A single pair between vectors and one lane.
#include "abut/geometry/pair_potential/lanes/lane_energy_2d.hpp"
#include "abut/geometry/pair_potential/lanes/lane_energy_3d.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::geometry::lanes {

template <int Dim>
LaneCorners<double, Dim> corners_of(const PairCorners<Dim>& corners) {
    LaneCorners<double, Dim> x;
    for (int v = 0; v < 2 * Dim; ++v)
        for (int d = 0; d < Dim; ++d) x.at[v].c[d] = corners[v][d];
    return x;
}

template <int Dim>
LaneLaw<double> law_of(const PairLaw<Dim>& law) {
    return {law.stiffness, {law.length[0], law.length[1]}, law.facing.full, law.facing.none, law.offset};
}

template <int Dim>
Vector<Dim> vector_of(const LaneVector<double, Dim>& a) {
    Vector<Dim> vector;
    for (int d = 0; d < Dim; ++d) vector[d] = a.c[d];
    return vector;
}

}  // namespace abut::geometry::lanes
