#pragma once
// Private to the layer.
#include <vector>

#include "abut/base/answers.hpp"
#include "abut/input/fault.hpp"
#include "abut/input/settings.hpp"
#include "abut/mesh/interpenetration.hpp"
#include "abut/run/scene.hpp"

namespace abut::input {

/// The obstacles of a scene; faults for those that cannot be made, or overlap bodies that they may not overlap.
template <int Dim>
void add_obstacles(run::Scene<Dim>& scene, const Settings& settings, Answers& mesh, mesh::IgnoredPairs may_overlap,
                   std::vector<Fault>& faults);

}  // namespace abut::input
