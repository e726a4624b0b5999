#pragma once
#include "abut/run/values/forward.hpp"
#include "abut/run/values/pilot_report.hpp"

namespace abut::run {

/// Runs the scene with rigid bodies, and picks for each the cheapest kinematics that what it showed allows:
///
///     rigid     if it takes less than a hundredth of the largest kinetic energy as elastic energy, at the start and later,
///     small     else, if it never turns by more than half of `far_rotation` and no other body that is not rigid does,
///     floating  else.
///
/// It cannot see what only elastic bodies do: bodies that bend, waves, what they lose to vibration before the next
/// collision. Throws BadInput naming the reason where the scene cannot be run with rigid bodies, as with prescribed
/// displacements: the user chooses then. Errors of the pilot run say that they are of it.
template <int Dim>
[[nodiscard]] PilotReport choose_kinematics(const Scene<Dim>& scene, const RunOptions& options);

}  // namespace abut::run
