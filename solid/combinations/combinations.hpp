#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "abut/solid/combinations/features.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/material/material.hpp"

namespace abut::solid {

/// A feature, and others that it does not go with; all combinations that stand in no row work.
struct Combination {
    Feature feature;
    FeatureSet without;
    std::string_view reason;  ///< a clause, behind "since"
    std::string_view remedy;  ///< one or two sentences
};

/// All combinations of features that are refused, whoever asks for them: a solid, a run, a scene or a program.
/// docs/limits.md shows them.
inline constexpr auto combinations = std::to_array<Combination>({
    // Supports, loads and bonds of a body
    {Feature::clamp,
     {Feature::floating, Feature::rigid},
     "a displacement is given in space, and a frame that turns has no place for it",
     "Take Kinematics::small or Kinematics::finite, or hold it by SolidOptions::springs."},
    {Feature::guide,
     {Feature::finite},
     "directions are those of space, and the faces turn",
     "Clamp it with Constraint::full and a constant value, or hold it by SolidOptions::springs."},
    {Feature::guide,
     {Feature::floating, Feature::rigid},
     "directions are those of space, and the faces turn",
     "Hold it by SolidOptions::springs."},
    {Feature::symmetry,
     {Feature::floating, Feature::finite, Feature::rigid},
     "the body may turn off its plane",
     "Take Kinematics::small, or run the whole of it."},
    {Feature::following_traction,
     {Feature::finite},
     "the body has no frame, and of what turns with a face the normal alone is known",
     "Leave follows out, or give a pressure."},
    {Feature::following_from_outside,
     {Feature::finite},
     "the body has no frame; the program that sets the traction knows its normals",
     "Give one that keeps its direction in space."},
    {Feature::dead_pressure,
     {Feature::floating, Feature::finite, Feature::rigid},
     "forces that stay while faces turn spin up a body that is pressed from all sides",
     "Leave follows out, or give a value, which keeps its direction."},
    {Feature::bond,
     {Feature::rigid},
     "bonds pull at faces through the cells behind them",
     "Let it deform (Kinematics::small, Kinematics::floating or Kinematics::finite), or join it by SolidOptions::springs."},
    {Feature::small_joint,
     {Feature::flow},
     "its cells behind the bond would yield as if nothing pulled there",
     "Let one of both be Kinematics::floating or Kinematics::finite, or take another material."},
    // Materials
    {Feature::large_strains,
     {Feature::small, Feature::floating},
     "strains are linear",
     "Take Kinematics::finite, or MaterialLaw::st_venant_kirchhoff."},
    {Feature::flow, {Feature::rigid}, "nothing deforms", "Take other kinematics, or another law."},
    {Feature::temperature,
     {Feature::rigid},
     "nothing deforms",
     "Take other kinematics, or leave SolidOptions::temperature_rise out."},
    {Feature::damping,
     {Feature::rigid},
     "nothing deforms",
     "Leave damping out, and give it a brake (SolidOptions::moments) or dashpots (SolidOptions::springs)."},
    {Feature::directed_rate,
     {Feature::finite},
     "the axes of such a law turn with the body, and a stress of rates along them is not made",
     "Take mass_damping, or Kinematics::floating."},
    {Feature::law_in_plane,
     {Feature::temperature},
     "heat stretches the body out of the plane, too, which such a law does not know",
     "Take a law of MaterialLaw, or a body in space."},
    {Feature::discrete_gradient,
     {Feature::large_strains, Feature::flow, Feature::damping, Feature::directions, Feature::temperature},
     "it is known for St. Venant and Kirchhoff's elastic energy alone",
     "Take MeanForce::closed_trapezoid."},
    {Feature::erosion_limit, {Feature::rigid}, "nothing deforms", "Take other kinematics, or leave erosion out."},
    // Contact
    {Feature::reconstruction,
     {Feature::turn},
     "the modified reconstruction knows normals at rest alone",
     "Take ContactLaw::pair_potential or ContactLaw::automatic."},
    {Feature::reconstruction,
     {Feature::breaking_bond},
     "under it bonds are for ever",
     "Take ContactLaw::pair_potential or ContactLaw::automatic, or leave the strength out."},
    {Feature::reconstruction,
     {Feature::interference},
     "the modified reconstruction knows no overlap at the start",
     "Take ContactLaw::pair_potential or ContactLaw::automatic."},
    {Feature::reconstruction,
     {Feature::flow},
     "cells behind a face that is moved would flow as if nothing pushed it",
     "Take ContactLaw::pair_potential, or another material."},
    // Where and how steps of the bulk are made
    {Feature::single_precision,
     {Feature::finite, Feature::flow, Feature::damping, Feature::directions, Feature::temperature},
     "it is made in double precision alone",
     "Take Precision::double_precision, or leave that out."},
    {Feature::device,
     {Feature::finite, Feature::flow, Feature::damping, Feature::directions, Feature::temperature},
     "it is made on the host alone",
     "Take StepDevice::host (--device host), or leave that out."},
    {Feature::single_precision,
     {Feature::device},
     "steps there are made in double precision alone",
     "Take Precision::double_precision, or StepDevice::host (--device host)."},
    // Schemes
    {Feature::end_forces,
     {Feature::flow, Feature::damping},
     "such a material remembers what happens to it, and forces at ends of steps do not tell",
     "Take the scheme memm, which closes its balance of energy, or another material."},
    {Feature::end_forces,
     {Feature::breaking_bond},
     "a bond gives way within a step, and forces at ends of steps do not tell",
     "Take the scheme memm, or leave the strength out."},
    {Feature::bilbao,
     {Feature::friction},
     "its potential knows no force that dissipates",
     "Take memm, which closes its balance of energy, or leapfrog; or leave friction out."},
    {Feature::bilbao,
     {Feature::varying_load, Feature::outside_work, Feature::interference},
     "its potential must not change with time",
     "Take memm or leapfrog, or leave it out."},
    {Feature::bilbao,
     {Feature::rigid},
     "it knows no distances that are held",
     "Take memm or leapfrog, or a body that deforms."},
    {Feature::local_steps,
     {Feature::floating, Feature::finite, Feature::rigid},
     "a frame couples all cells of its body, and forces of large strains are not linear",
     "Take one step for all cells (memm), or Kinematics::small."},
    {Feature::local_steps,
     {Feature::friction},
     "friction is that of whole steps",
     "Take memm, which closes its balance of energy, or leapfrog; or leave friction out."},
    {Feature::local_steps,
     {Feature::flow, Feature::damping},
     "such a material remembers whole steps",
     "Take memm, which closes its balance of energy, or another material."},
    {Feature::local_steps,
     {Feature::pair_potential},
     "this law knows whole steps alone",
     "Take one step for all cells (memm), or ContactLaw::reconstruction."},
    {Feature::local_steps,
     {Feature::bonded, Feature::varying_load, Feature::mesh_change},
     "local steps do not see it",
     "Take one step for all cells (memm)."},
    {Feature::local_steps,
     {Feature::single_precision, Feature::device},
     "they are made in double precision on the host alone",
     "Take Precision::double_precision and StepDevice::host (--device host), or one step for all cells (memm)."},
    // Cells that leave
    {Feature::erosion,
     {Feature::end_forces, Feature::local_steps},
     "what leaves is booked in the balance of whole steps of memm",
     "Take the scheme memm, or leave erosion out."},
    {Feature::erosion,
     {Feature::bonded},
     "a bond has no place left once the cells of one side are gone",
     "Leave out either the bonds (fracture, too) or erosion."},
    {Feature::erosion,
     {Feature::single_precision, Feature::device},
     "steps there do not look at strains",
     "Take Precision::double_precision and StepDevice::host (--device host), or leave erosion out."},
    {Feature::erosion,
     {Feature::ranks, Feature::pieces},
     "it is not made for a run on several ranks yet",
     "Run it on one and without --pieces, or leave erosion out."},
    {Feature::erosion,
     {Feature::pilot},
     "its pilot run is one of rigid bodies, which keep their cells",
     "Choose the kinematics of each body, or leave erosion out."},
    {Feature::erosion,
     {Feature::stepped_run},
     "whoever takes the steps takes out cells, too",
     "Leave erosion out, and take cells out between steps (remove_cells in Python), or let Abut run the whole."},
    // States at rest
    {Feature::rest,
     {Feature::floating, Feature::rigid},
     "the search knows no turns of frames and of rigid bodies",
     "Take Kinematics::small or Kinematics::finite, or a run with damping."},
    {Feature::loaded_rest,
     {Feature::floating, Feature::finite, Feature::rigid},
     "forces that turn with faces have no potential",
     "Load it by SolidOptions::body_load, SolidOptions::acceleration or SolidOptions::springs."},
    // Runs
    {Feature::ranks,
     {Feature::local_steps, Feature::reconstructed_bond, Feature::single_precision, Feature::device, Feature::mesh_change,
      Feature::vertex_displacement, Feature::pilot, Feature::step_watcher},
     "it is not made for a run on several ranks yet",
     "Run it on one, or leave it out."},
    {Feature::spin_of_rigid,
     {Feature::displaced_start},
     "a rigid body takes its spin from velocities of its cells at rest",
     "Turn its mesh instead, and leave Scene::displacement out."},
    {Feature::spin_of_rigid,
     {Feature::settling},
     "a rigid body takes its spin from velocities of its cells at rest, and comes to rest elsewhere",
     "Leave Scene::spin and Scene::added_velocity out, or --settle."},
    {Feature::pieces,
     {Feature::xdmf},
     "pieces are written as vtu alone",
     "Leave --pieces out: rank 0 then writes the whole as xdmf; or leave --format xdmf out."},
    {Feature::output_times,
     {Feature::local_steps},
     "cells with local steps have nodes of their own",
     "Take one step for all cells (memm), or frames that are equally far apart (--frames)."},
    {Feature::output_times,
     {Feature::pieces},
     "pieces are those of nodes",
     "Leave --pieces out: rank 0 then writes the whole; or take frames that are equally far apart (--frames)."},
});

/// Features that do not go together: a row, and which of those without which it is.
struct Conflict {
    const Combination* row;
    Feature other;
};
/// The first of the table between two of these features, of which one is `among` those.
[[nodiscard]] std::optional<Conflict> first_conflict(FeatureSet features, FeatureSet among);
[[nodiscard]] bool go_together(Feature one, Feature other);
/// "<who> is rigid and yields: nothing deforms. Take other kinematics, or another law." `who`: "body 'ring'"; not needed
/// where no feature is of a body.
[[nodiscard]] std::string text_of(const Conflict& conflict, const std::string& who = {});
/// Throws BadInput for the first conflict among the features, with `where` and a colon in front unless it is empty.
void require_together(const std::string& where, const std::string& who, FeatureSet features);
/// The table as Markdown, a line per row, with a head.
[[nodiscard]] std::string combinations_table();

[[nodiscard]] constexpr Feature feature_of(Kinematics kinematics) { return static_cast<Feature>(kinematics); }
/// Features of a body by these two alone.
[[nodiscard]] FeatureSet features_of(Kinematics kinematics, const Material& material);

}  // namespace abut::solid
