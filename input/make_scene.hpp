#pragma once
// Private to the layer.
#include <vector>

#include "abut/base/answers.hpp"
#include "abut/input/fault.hpp"
#include "abut/input/settings.hpp"
#include "abut/run/scene.hpp"

namespace abut::input {

/// The scene of these settings. Faults: meshes that cannot be made or read, groups that are none, bodies that overlap.
/// Bodies without a shape are left out, and what belongs to them is not looked at; with a fault the scene is not to be
/// run. All that depends on cells and faces is asked of `mesh`: where its answers are given, those to the same settings
/// without a fault, no mesh is made, and the scene has its outline (mesh::outline_of).
template <int Dim>
[[nodiscard]] run::Scene<Dim> make_scene(const Settings& settings, Answers& mesh, std::vector<Fault>& faults);

}  // namespace abut::input
