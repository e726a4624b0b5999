#pragma once
// Private to the layer.
#include <vector>

#include "abut/base/answers.hpp"
#include "abut/input/fault.hpp"
#include "abut/input/settings.hpp"
#include "abut/run/scene.hpp"

namespace abut::input {

/// Supports, tractions, springs and moments, on the mesh that the scene has; faults for groups and bodies that are none.
/// Those of bodies that could not be made are not known, and no fault.
template <int Dim>
void add_loads(run::Scene<Dim>& scene, const Settings& settings, Answers& mesh, std::vector<Fault>& faults);

}  // namespace abut::input
