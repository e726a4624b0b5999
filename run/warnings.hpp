#pragma once
#include <string>
#include <vector>

#include "abut/run/forward.hpp"

namespace abut::run {

/// Ratio of the forces of sliding and pressing above which contacts were seen to be stiffer than the stable step allows for
/// [-]. docs/limits.md, docs/validation.md.
inline constexpr double stiff_sliding_ratio = 1.0;
/// |g|/D above which faces that slide off each other are worth a word [-]: two coarse discs part with up to 0.2.
/// docs/limits.md.
inline constexpr double deep_slip_compression = 0.3;

/// Angle by which a body may turn without a warning [rad]: it has grown by 0.5 % then. docs/limits.md.
inline constexpr double far_rotation = 0.1;

/// I / I_exact below which a body that may turn is worth a word [-]: it turns and precesses faster by as much.
/// docs/limits.md.
inline constexpr double enough_inertia = 0.98;

/// |E| above which the strain of a finite body is worth a word [-]: its material is one of small strains. docs/limits.md.
inline constexpr double large_strain = 0.2;

/// Plastic strain above which kinematic hardening of finite bodies may be another rule than of metal without it [-]: in
/// simple shear of 1, which is 0.58 of it, its stress is 3 % lower. docs/limits.md.
inline constexpr double large_kinematic_flow = 0.6;

/// The size of Losses::on_faces over `in_cells` above which free faces that flow along take more than they should [-]:
/// a bar eight cells across has 0.02, boxes three cells across that collide 0.16. docs/limits.md.
inline constexpr double large_face_loss = 0.1;

/// The part of what cells and jumps between them dissipate by plastic flow that jumps have, above which these yield
/// more than they should [-]: spheres and bars at their limit loads have 0.01 to 0.05, bars that collide at most 0.06.
/// docs/validation.md.
inline constexpr double large_jump_loss = 0.1;

/// Force of sliding faces over the limit at which they slide, in a part of a run (SlidingWindows): far below it their slip
/// alternates from step to step [-]. Sound runs have 0.64 and more, the least where a block comes to a stop, and lost ones
/// 0.05 and less (docs/friction.md).
inline constexpr double least_sliding_share = 0.4;
/// Time in which bodies slide on less friction than belongs to their normal force (WeakFriction), over that of the run,
/// above which it is told [-].
inline constexpr double weak_friction_time = 0.1;
/// (H - H~) over the energy in play above which the motion swings from step to step by more than belongs to it [-].
inline constexpr double large_energy_excess = 0.02;
/// |e|/m over the largest speed above which values of single cells near contact are not usable [-]. Good impacts have 0.2 to
/// 0.4 in single cells, with H - H~ below 0.1 % and velocities after impact that a filter changes by 1e-4.
inline constexpr double large_parasitic_share = 0.5;
/// The change of J~, where it is conserved, over what it may be with that energy, above which it is no round-off [-].
inline constexpr double large_moment_drift = 1e-6;
/// Depth of cells of different bodies inside each other, over the size of the smaller one, where contact has not prevented
/// it [-].
inline constexpr double deep_interpenetration = 0.5;
/// Distance of faces that push each other, over the size of the smaller one, where they cannot touch [-].
inline constexpr double contact_from_afar = 0.25;
/// Contact pressure over E above which sliding over faces that do not lie in a plane may cost more than 1 % of the
/// speed [-]: a note. The slipping cylinders have 0.12 and, 16 cells across, a velocity that is 0.7 % off that of 128.
inline constexpr double high_sliding_pressure = 0.15;

/// The time of the slowest cell over the median (SlowCell::share), below which a few bad cells cost most of the run
/// [-]. Meshes of Gmsh have 0.15 and more.
inline constexpr double slow_cell_share = 0.1;
/// SlowCell::of_body below which a run does not begin: it would take a hundred times as long as for the other cells [-].
inline constexpr double least_cell_share = 0.01;

/// Bonded area over that where the sides of a bond lie opposite each other, below which glue is missing [-].
inline constexpr double enough_bond = 0.99;

enum class Severity {
    note,     ///< as it should be, and good to know
    warning,  ///< may spoil the result
};

/// Subject of a warning, with what its `value` counts; what is counted has the threshold 0.
enum class WarningKind {
    mesh_file,            ///< the reader of a file warned; no value
    unused_vertices,      ///< note: vertices that belong to no cell
    ignored_elements,     ///< note: elements of a file that are neither cells nor named faces
    turned_cells,         ///< note: cells that were given inside out, and are turned
    cut_cells,            ///< note: cells that were cut because of faces that are not planar
    coincident_vertices,  ///< note: vertices at the place of one of another body
    unjoined_faces,       ///< faces that lie on others of their body and are not joined to them
    missing_bond,         ///< BondCoverage::share of a bond [-]; threshold: enough_bond
    slow_cell,            ///< SlowCell::share of the cell that decides the step [-]; threshold: slow_cell_share
    missing_inertia,      ///< BodyInertia::least of a body that may turn [-]; threshold: enough_inertia
    extrapolated_faces,   ///< note: faces that extrapolate from the cells around them: the stable step is shorter
    blind_corners,        ///< corners too sharp for contact to see
    unseen_edges,     ///< how much crossing edges look at each other [-]; threshold: below it the law that acts misses them
    behind_obstacle,  ///< a body, or all of them, behind an obstacle at the start; no value
    hidden_mode,     ///< RunOptions::interval where every record comes right after a restart; threshold: RunOptions::restart
    compression,     ///< Compressed::compression [-]; threshold: ContactOptions::compression_warning
    stiff_sliding,   ///< ContactReport::sliding_ratio_max [-]; threshold: stiff_sliding_ratio
    past_rim,        ///< time at which a body was past the rim of a flat obstacle [s]
    look_ended,      ///< the time from which on a body is not watched any more for parts that come together [s]
    near_itself,     ///< gap of a body with itself [m]; threshold: that at which it is said
    deep_slip,       ///< ContactReport::slipped_compression_max [-]; threshold: deep_slip_compression
    rotation,        ///< RunResult::turned [rad]; threshold: far_rotation
    local_rotation,  ///< the largest of RunResult::local_rotations of bodies that may turn [rad]; threshold: far_rotation
    finite_strain,   ///< FiniteExtremes::strain [-] of bodies of Kinematics::finite; threshold: large_strain
    kinematic_flow,  ///< FiniteExtremes::plastic_strain [-] where a finite body hardens kinematically; threshold: large_kinematic_flow
    alternating_slip,  ///< force of sliding faces over its limit [-]; threshold: least_sliding_share
    weak_friction,  ///< time in which bodies slid with too little friction [s]; threshold: weak_friction_time of that of the run
    face_loss,      ///< size of what RunResult::dissipated has `on_faces` over that in cells [-]; threshold: large_face_loss
    jump_loss,      ///< part of the plastic dissipation that jumps between cells have [-]; threshold: large_jump_loss
    energy_excess,          ///< Ledger::energy_excess over the energy in play [-]; threshold: large_energy_excess
    parasitic,              ///< Ledger::parasitic over Accounts::speed [-]; threshold: large_parasitic_share
    fine_motion,            ///< RunResult::fine_energy_max over the energy in play [-]; threshold: large_fine_share
    moment_drift,           ///< of J~ where it is conserved [-]; threshold: large_moment_drift
    interpenetration,       ///< SurfaceLooks::deepest [-]; threshold: deep_interpenetration
    remote_contact,         ///< SurfaceLooks::remote [-]; threshold: contact_from_afar
    sliding_pressure,       ///< note: SurfaceLooks::pressed [-]; threshold: high_sliding_pressure
    nothing_touched,        ///< note: the distance of the two that were nearest at the end [m]
    missed_contacts,        ///< contacts that were missed: the energy is not exact
    inadmissible_overlaps,  ///< note: pairs of faces that overlap without being contacts, far sides of bodies
};

/// Something that the user of a run ought to know and that is no error.
struct Warning {
    WarningKind kind;
    Severity severity;
    std::string text;  ///< a sentence without its full stop: what, how much, how much is safe, what to do
    double value;      ///< see WarningKind; NaN: none
    double
        threshold;  ///< above which (unseen_edges, missing_bond, slow_cell, missing_inertia, alternating_slip: below which) `value` is worth a word
};

/// Known once all is set up, before the first step: of the mesh, the reconstruction, the surface. For Observer::begin.
template <int Dim>
[[nodiscard]] std::vector<Warning> warnings_before(const Scene<Dim>& scene, const RunResult<Dim>& result);

/// Known while a run goes on, at a step: bodies past a rim and together with themselves, in the order in which they
/// were seen, and last that faces are strongly compressed. For Observer::record.
template <int Dim>
[[nodiscard]] std::vector<Warning> warnings_during(std::int64_t step, const RunResult<Dim>& result);

/// Warnings of what happened in contact of a finished run and mostly does not show in H~.
template <int Dim>
[[nodiscard]] std::vector<Warning> warnings_after(const RunResult<Dim>& result);

/// Warnings that may spoil the result.
[[nodiscard]] std::vector<Warning> without_notes(std::vector<Warning> warnings);

}  // namespace abut::run
