#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/contact/surface/obstacle.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"
#include "abut/solid/ccg/step_device.hpp"
#include "abut/solid/cells/finite_options.hpp"
#include "abut/solid/cells/temperature.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/material.hpp"
#include "abut/solid/operator/precision.hpp"
#include "abut/solid/options/attachments.hpp"
#include "abut/solid/options/erosion_limits.hpp"

namespace abut::solid {

/// Steps between neutral restarts of runs with friction: without them the slip of faces that vibrate alternates from
/// step to step, and friction vanishes (docs/filter.md).
inline constexpr int restart_with_friction = 10;

/// Friction between two bodies, obstacles or groups. Of several for two faces, that with more groups counts, then the first.
struct BodyFriction {
    std::array<std::int32_t, 2> bodies;  ///< either order; obstacle i: n_bodies + i; group g of the mesh: behind them
    contact::Friction law;
};

/// Two bodies, obstacles or groups that overlap at the start on purpose (contact::InterferenceOptions); under the pair
/// potential.
struct BodyInterference {
    std::array<std::int32_t, 2> bodies;  ///< as BodyFriction::bodies
    double time;                         ///< over which the overlap comes to act [s] > 0
};

/// Content of a scene beside its mesh.
template <int Dim>
struct SolidOptions {
    std::vector<Material> materials;     ///< one per body
    std::vector<Kinematics> kinematics;  ///< one per body; empty: all `small`
    FiniteOptions<Dim> finite;           ///< of bodies of Kinematics::finite; of `stored_energy` null: as Material::law says
    BoundaryConditions<Dim> boundary;
    std::vector<Vector<Dim>> acceleration;  ///< of gravity, one per body [m/s^2]; empty: none
    std::function<Vector<Dim>(const Vector<Dim>& position)>
        body_load;  ///< force density [N/m^3], constant in time; empty: none
    /// One per body, of those that deform; empty: none
    std::vector<TemperatureRise<Dim>> temperature_rise = {};
    std::vector<Spring<Dim>> springs;
    std::vector<BodyMoment<Dim>> moments;
    std::vector<Bond> bonds;
    std::optional<contact::ContactOptions> contact;  ///< empty: bodies pass through each other, at no cost
    ContactLaw law = ContactLaw::automatic;
    geometry::FacingFade facing;                         ///< of `pair_potential` (contact::NodalOptions)
    bool gauss = false;                                  ///< the same
    std::vector<contact::RigidObstacle<Dim>> obstacles;  ///< with contact only
    /// Pairs of bodies, in either order, that pass through each other; obstacle i is body n_bodies + i
    std::vector<std::array<std::int32_t, 2>> ignored_pairs = {};
    contact::Friction friction = {};  ///< between all bodies and obstacles that have no law of their own
    std::vector<BodyFriction> body_friction = {};
    std::vector<BodyInterference> interference = {};
    /// One per body; empty: cells stay. A solid keeps in mind how far cells are strained; whoever takes its steps takes
    /// them out (solid/erosion.hpp)
    std::vector<ErosionLimits> erosion = {};
    Precision precision = Precision::double_precision;  ///< of the bulk in steps: `mean_force` and `end_force`
    StepDevice device = StepDevice::host;               ///< of the same

    [[nodiscard]] bool has_friction() const {
        return friction.acts() || std::ranges::any_of(body_friction, [](const BodyFriction& one) { return one.law.acts(); });
    }
};

/// Time spent in the parts of all steps of a Solid [s].
struct SolidTimes {
    double bulk = 0.0;
    double contact = 0.0;
    double search = 0.0;
    /// Processor time in the operators of the cells of this rank: what it computes alone, without waiting for others
    double own_cells = 0.0;
};

}  // namespace abut::solid
