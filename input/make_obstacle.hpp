#pragma once
// Private to the layer.
#include <vector>

#include "abut/input/fault.hpp"
#include "abut/input/settings.hpp"
#include "abut/run/scene.hpp"

namespace abut::input {

/// The obstacles of a scene; faults for those that cannot be made.
template <int Dim>
void add_obstacles(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults);

}  // namespace abut::input
