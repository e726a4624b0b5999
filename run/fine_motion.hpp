#pragma once
// Private to the layer.
#include "abut/run/forward.hpp"

namespace abut::dynamics {
template <int Dim>
class RunView;
}

namespace abut::run {

/// Share of the energy in play that fine_kinetic_energy may have [-]. docs/results.md, The verdict.
inline constexpr double large_fine_share = 0.1;

/// Kinetic energy of motion that changes from cell to cell [J]: of half the difference between the velocity of a cell and
/// the mean of its neighbours. A wave has sin^4(kh/2) of its energy in it: a quarter or more in the upper half of the modes.
/// Cells with neighbours on both sides stand for their bodies. Velocities are those of the step to come, in which modes
/// that change sign from step to step are whole.
template <int Dim>
[[nodiscard]] double fine_kinetic_energy(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid);

}  // namespace abut::run
