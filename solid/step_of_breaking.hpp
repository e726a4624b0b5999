#pragma once
#include "abut/dynamics/stable_step.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

/// The stable step of a solid whose bonds may break in a run: that of the solid as it is or with all bonds broken that have
/// a strength, whichever is less. Faces that are let go may vibrate faster than bonded ones: a box in grains of
/// tetrahedra by a third. Without such bonds it is dynamics::stable_step. Throws as dynamics::stable_step.
template <int Dim>
[[nodiscard]] dynamics::StableStep step_of_breaking(Solid<Dim>& solid);

}  // namespace abut::solid
