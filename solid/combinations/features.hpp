#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace abut::solid {

/// Features of a scene that do not go with every other one (`combinations`). Those of one body come first.
enum class Feature {
    small,  ///< kinematics, in the order of Kinematics
    floating,
    finite,
    rigid,
    turn,                    ///< by any angle, of a body or an obstacle
    clamp,                   ///< faces whose displacement is prescribed in all directions and constant
    guide,                   ///< faces whose prescribed displacement varies or leaves directions free
    symmetry,                ///< faces that stay on a plane
    following_traction,      ///< one that turns with the body and is no pressure
    following_from_outside,  ///< the same, set by another program between steps
    dead_pressure,           ///< forces of a pressure that stay as they are while faces turn
    bond,                    ///< faces that hold on to those of another body
    small_joint,             ///< a bond between two small bodies
    large_strains,           ///< a law whose energy is not that of small strains
    law_in_plane,            ///< a law of a host's own (FiniteOptions) in the plane
    flow,                    ///< a material that yields
    damping,                 ///< of the material: Rayleigh's and viscosity
    directions,              ///< other moduli along each axis
    directed_rate,           ///< stiffness_damping or viscosity of such a material
    temperature,             ///< that is given, and strains
    discrete_gradient,       ///< MeanForce::discrete_gradient of a finite body
    erosion_limit,           ///< limits beyond which its cells leave
    bonded,                  ///< any bond
    breaking_bond,           ///< a bond with a strength
    reconstructed_bond,      ///< any bond under ContactLaw::reconstruction
    interference,            ///< bodies that overlap at the start on purpose
    friction,                ///< bodies that rub
    varying_load,            ///< a condition or a temperature that varies, or a load from outside
    outside_work,            ///< dashpots, moments, tractions on bodies that turn, and obstacles that move
    reconstruction,          ///< ContactLaw::reconstruction
    pair_potential,          ///< ContactLaw::pair_potential
    single_precision,        ///< steps of the bulk in it
    device,                  ///< steps of the bulk there
    ranks,                   ///< several of them
    local_steps,             ///< steps of its own for each cell (memm_async)
    end_forces,              ///< schemes that take forces at the ends of steps (leapfrog, bilbao)
    bilbao,
    rest,                 ///< a state at rest that is sought (`solve_statics`)
    loaded_rest,          ///< the same under tractions or moments
    mesh_change,          ///< cells that are taken out during a run, or other numbers
    erosion,              ///< cells that leave a run by limits or by a function
    stepped_run,          ///< another program that takes the steps
    vertex_displacement,  ///< displacements of the vertices of the mesh
    pilot,                ///< a run that chooses the kinematics
    step_watcher,         ///< a function that sees each step (Scene::after_step)
    spin_of_rigid,        ///< a spin or added velocities of a rigid body
    displaced_start,      ///< a displacement at the start
    settling,             ///< bodies that come to rest before the run
    pieces,               ///< frames that each rank writes its part of
    xdmf,                 ///< frames in one file of HDF5
    output_times,         ///< frames at times that are given
};
inline constexpr std::size_t n_features = static_cast<std::size_t>(Feature::output_times) + 1;
/// Features from here on are of the whole scene, and of no body.
inline constexpr Feature first_of_scene = Feature::bonded;

/// Words for a feature: in a table; in a message, a clause, of a feature of a body without its subject.
struct FeatureWords {
    Feature feature;
    std::string_view name;
    std::string_view clause;
};

inline constexpr std::array<FeatureWords, n_features> feature_words{{
    {Feature::small, "kinematics \"small\"", "is of Kinematics::small"},
    {Feature::floating, "kinematics \"floating\"", "is of Kinematics::floating"},
    {Feature::finite, "kinematics \"finite\"", "is of Kinematics::finite"},
    {Feature::rigid, "kinematics \"rigid\"", "is rigid"},
    {Feature::turn, "a body or an obstacle that may turn", "may turn"},
    {Feature::clamp, "clamp", "has a prescribed displacement"},
    {Feature::guide, "guide", "has a prescribed displacement that varies or leaves directions free"},
    {Feature::symmetry, "symmetry", "is cut by a plane of symmetry"},
    {Feature::following_traction, "following traction", "has a traction that follows and is no pressure"},
    {Feature::following_from_outside, "following traction from outside", "has a traction from outside that follows"},
    {Feature::dead_pressure, "pressure that does not follow", "has a pressure that does not follow"},
    {Feature::bond, "bond", "is bonded"},
    {Feature::small_joint, "bond of two small bodies", "is bonded to another small one"},
    {Feature::large_strains, "law of large strains", "has a law of large strains"},
    {Feature::law_in_plane, "law of its own in the plane", "has a law of its own (FiniteOptions) in the plane"},
    {Feature::flow, "metal that yields", "yields (law = \"j2\")"},
    {Feature::damping, "damping and viscosity of the material", "has a damped or viscous material"},
    {Feature::directions, "orthotropic material", "has an orthotropic material"},
    {Feature::directed_rate, "stiffness_damping or viscosity of an orthotropic material",
     "has an orthotropic material with stiffness_damping or viscosity"},
    {Feature::temperature, "temperature", "is given a temperature"},
    {Feature::discrete_gradient, "mean_force \"discrete_gradient\" of a finite body",
     "takes its mean force by MeanForce::discrete_gradient"},
    {Feature::erosion_limit, "erosion of a body", "has limits of erosion"},
    {Feature::bonded, "bonds", "bodies are bonded"},
    {Feature::breaking_bond, "bond with a strength", "a bond has a strength"},
    {Feature::reconstructed_bond, "bonds under law \"reconstruction\"",
     "bodies are bonded under the modified reconstruction"},
    {Feature::interference, "interference", "bodies overlap at the start on purpose (interference)"},
    {Feature::friction, "friction", "bodies rub"},
    {Feature::varying_load, "load, support or temperature that varies or is set from outside",
     "a boundary condition has a history or is set from outside, or a temperature varies"},
    {Feature::outside_work, "dashpot, moment, traction on a body that turns, obstacle that moves",
     "a dashpot, a moment, a traction on a body that turns or an obstacle that moves does work"},
    {Feature::reconstruction, "law \"reconstruction\"", "contact is by ContactLaw::reconstruction"},
    {Feature::pair_potential, "law \"pair_potential\"", "contact is by ContactLaw::pair_potential"},
    {Feature::single_precision, "single precision", "steps of the bulk are made in single precision"},
    {Feature::device, "device", "steps of the bulk are made on a device"},
    {Feature::ranks, "several ranks", "there are several ranks"},
    {Feature::local_steps, "integrator \"memm_async\"", "cells have local steps (memm_async)"},
    {Feature::end_forces, "integrators \"leapfrog\" and \"bilbao\"",
     "the scheme takes forces at the ends of steps, as leapfrog and bilbao do"},
    {Feature::bilbao, "integrator \"bilbao\"", "the scheme is bilbao"},
    {Feature::rest, "state at rest that is sought", "a state at rest is sought (statics)"},
    {Feature::loaded_rest, "the same under tractions or moments",
     "a state at rest is sought under tractions or moments (statics)"},
    {Feature::mesh_change, "change of the mesh", "the mesh is changed"},
    {Feature::erosion, "erosion", "cells leave the run (erosion)"},
    {Feature::stepped_run, "steps or times from another program", "another program takes the steps, or dictates times"},
    {Feature::vertex_displacement, "displacements of vertices", "displacements of vertices are asked for"},
    {Feature::pilot, "kinematics \"automatic\"", "a pilot run chooses kinematics (--kinematics automatic)"},
    {Feature::step_watcher, "function that sees each step", "the scene looks at each step (Scene::after_step)"},
    {Feature::spin_of_rigid, "spin or added velocities of a rigid body", "a rigid body spins or has added velocities"},
    {Feature::displaced_start, "displacement at the start", "Scene::displacement moves bodies at the start"},
    {Feature::settling, "settle", "bodies come to rest first (--settle)"},
    {Feature::pieces, "frames in pieces", "ranks write pieces of frames (--pieces)"},
    {Feature::xdmf, "frames as xdmf", "frames are written as xdmf (--format xdmf)"},
    {Feature::output_times, "frames at given times", "frames are at given times (output.times)"},
}};

[[nodiscard]] constexpr const FeatureWords& words_of(Feature feature) {
    return feature_words[static_cast<std::size_t>(feature)];
}
[[nodiscard]] constexpr bool is_of_body(Feature feature) { return feature < first_of_scene; }

/// Features that a body or a scene has.
class FeatureSet {
public:
    constexpr FeatureSet() = default;
    constexpr FeatureSet(std::initializer_list<Feature> features) {
        for (const Feature feature : features) add(feature);
    }
    constexpr void add(Feature feature, bool if_it_has = true) {
        if (if_it_has) bits_ |= bit(feature);
    }
    constexpr void remove(FeatureSet others) { bits_ &= ~others.bits_; }
    [[nodiscard]] constexpr bool has(Feature feature) const { return (bits_ & bit(feature)) != 0; }
    [[nodiscard]] constexpr FeatureSet operator|(FeatureSet other) const {
        other.bits_ |= bits_;
        return other;
    }
    [[nodiscard]] constexpr FeatureSet operator&(FeatureSet other) const {
        other.bits_ &= bits_;
        return other;
    }
    [[nodiscard]] constexpr bool is_empty() const { return bits_ == 0; }

private:
    [[nodiscard]] static constexpr std::uint64_t bit(Feature feature) {
        return std::uint64_t{1} << static_cast<unsigned>(feature);
    }
    std::uint64_t bits_ = 0;
};
static_assert(n_features <= 64);

}  // namespace abut::solid
