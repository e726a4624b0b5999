#pragma once
#include <span>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

/// Mass and mean velocity of a body.
template <int Dim>
struct BodyMotion {
    double mass;           ///< [kg]
    Vector<Dim> velocity;  ///< of the centre of mass, from p = (p^- + p^+)/2 [m/s]
};
template <int Dim>
[[nodiscard]] std::vector<BodyMotion<Dim>> body_motions(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid);

/// Momenta of bodies that move as a whole, one velocity per body [m/s].
template <int Dim>
[[nodiscard]] std::vector<double> uniform_momentum(const Solid<Dim>& solid, std::span<const Vector<Dim>> body_velocity);

}  // namespace abut::solid
