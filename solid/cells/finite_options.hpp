#pragma once
#include <memory>
#include <vector>

#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/inelastic.hpp"
#include "abut/solid/material/stored_energy.hpp"

namespace abut::solid {

/// Options of bodies of Kinematics::finite.
template <int Dim>
struct FiniteOptions {
    MeanForce mean_force = MeanForce::automatic;
    /// One per body; null: St. Venant and Kirchhoff's material. Empty: that for all. Not with MeanForce::discrete_gradient
    std::vector<std::shared_ptr<const StoredEnergy<Dim>>> stored_energy = {};
    /// One per body; null: it is elastic. Empty: all are. Not with MeanForce::discrete_gradient
    std::vector<std::shared_ptr<const InelasticLaw<Dim>>> inelastic = {};
};

}  // namespace abut::solid
