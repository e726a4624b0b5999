#pragma once
// Private to the layer.
#include <vector>

#include "abut/base/answers.hpp"
#include "abut/input/fault.hpp"
#include "abut/input/settings.hpp"
#include "abut/run/scene.hpp"

namespace abut::input {

/// Bodies of one table that are one piece, of several materials (BuildReport::joined_bodies): they are bonded for ever,
/// and turn about the centroid of the piece. They touch each other if all of them touch themselves. Faults where one is
/// rigid, or moves otherwise than the piece. Grains of a body that may break are bonded as its `fracture` says, and touch
/// each other; faults where they do not turn.
template <int Dim>
void join_parts(run::Scene<Dim>& scene, const Settings& settings, Answers& mesh, std::vector<Fault>& faults);

}  // namespace abut::input
