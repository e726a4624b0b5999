#pragma once
// Private to the layer.
#include <vector>

#include "abut/input/fault.hpp"
#include "abut/input/settings.hpp"
#include "abut/run/scene.hpp"

namespace abut::input {

/// The scene of these settings. Faults: meshes that cannot be made or read, groups that are none, bodies that overlap.
/// Bodies without a shape are left out, and what belongs to them is not looked at; with a fault the scene is not to be
/// run.
template <int Dim>
[[nodiscard]] run::Scene<Dim> make_scene(const Settings& settings, std::vector<Fault>& faults);

}  // namespace abut::input
