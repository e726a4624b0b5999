#pragma once
// Private to the layer.
#include <span>

#include "abut/run/scene.hpp"

namespace abut::run {

/// Contact at the start can only push what touches. Throws BadInput where it stores more than 1e-6 of `scale` [J], the
/// energy that the run begins with, and more than `rest_energy` [J], between bodies or obstacles whose surfaces are
/// apart: with both names, place, distance, energy and remedy. `q` is the state at the start. What it costs is one
/// evaluation of contact, and a search around the faces that push where there are any. A call of all ranks.
template <int Dim>
void check_start_contact(const Scene<Dim>& scene, solid::Solid<Dim>& solid, std::span<const double> q, double scale,
                         double rest_energy);

}  // namespace abut::run
