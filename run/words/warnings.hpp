#pragma once
#include <string>
#include <vector>

#include "abut/run/values/forward.hpp"
#include "abut/run/watch/thresholds.hpp"

namespace abut::run {

enum class Severity {
    note,     ///< as it should be, and good to know
    warning,  ///< may spoil the result
};

/// Subject of a warning, with what its `value` counts; what is counted has the threshold 0.
enum class WarningKind {
    mesh_file,              ///< the reader of a file warned; no value
    unused_vertices,        ///< note: vertices that belong to no cell
    ignored_elements,       ///< note: elements of a file that are neither cells nor named faces
    turned_cells,           ///< note: cells that were given inside out, and are turned
    cut_cells,              ///< note: cells that were cut because of faces that are not planar
    coincident_vertices,    ///< note: vertices at the place of one of another body
    unjoined_faces,         ///< faces that lie on others of their body and are not joined to them
    missing_bond,           ///< BondCoverage::share of a bond [-]; threshold: enough_bond
    short_cohesive_length,  ///< BondCoverage::cohesive_length [-]; threshold: enough_cohesive_length
    scattered_grains,       ///< bonds between grains that are springs
    slow_cell,              ///< SlowCell::share of the cell that decides the step [-]; threshold: slow_cell_share
    missing_inertia,        ///< BodyInertia::least of a body that may turn [-]; threshold: enough_inertia
    extrapolated_faces,     ///< note: faces that extrapolate from the cells around them: the stable step is shorter
    blind_corners,          ///< corners too sharp for contact to see
    unseen_edges,     ///< how much crossing edges look at each other [-]; threshold: below it the law that acts misses them
    behind_obstacle,  ///< a body, or all of them, behind an obstacle at the start; no value
    hidden_mode,     ///< RunOptions::interval where every record comes right after a restart; threshold: RunOptions::restart
    compression,     ///< Compressed::compression [-]; threshold: ContactOptions::compression_warning
    stiff_sliding,   ///< ContactReport::sliding_ratio_max [-]; threshold: stiff_sliding_ratio
    past_rim,        ///< time at which a body was past the rim of a flat obstacle [s]
    look_ended,      ///< the time from which on a body is not watched any more for parts that come together [s]
    near_itself,     ///< gap of a body with itself [m]; threshold: that at which it is said
    deep_slip,       ///< ContactReport::slipped_compression_max [-]; threshold: deep_slip_compression
    rotation,        ///< RunWatch::turned [rad]; threshold: far_rotation
    local_rotation,  ///< the largest of RunBodies::local_rotations of bodies that may turn [rad]; threshold: far_rotation
    finite_strain,   ///< FiniteExtremes::strain [-] of bodies of Kinematics::finite; threshold: large_strain
    kinematic_flow,  ///< FiniteExtremes::plastic_strain [-] where a finite body hardens kinematically; threshold: large_kinematic_flow
    alternating_slip,  ///< force of sliding faces over its limit [-]; threshold: least_sliding_share
    weak_friction,  ///< time in which bodies slid with too little friction [s]; threshold: weak_friction_time of that of the run
    face_loss,      ///< size of what RunEnergy::dissipated has `on_faces` over that in cells [-]; threshold: large_face_loss
    returned_flow,  ///< ReturnedFlow::share [-]; threshold: large_returned_flow
    jump_loss,      ///< part of the plastic dissipation that jumps between cells have [-]; threshold: large_jump_loss
    energy_excess,          ///< Ledger::energy_excess over the energy in play [-]; threshold: large_energy_excess
    parasitic,              ///< Ledger::parasitic over Accounts::speed [-]; threshold: large_parasitic_share
    fine_motion,            ///< RunEnergy::fine_max over the energy in play [-]; threshold: large_fine_share
    moment_drift,           ///< of J~ where it is conserved [-]; threshold: large_moment_drift
    interpenetration,       ///< SurfaceLooks::deepest [-]; threshold: deep_interpenetration
    remote_contact,         ///< SurfaceLooks::remote [-]; threshold: contact_from_afar
    sliding_pressure,       ///< note: SurfaceLooks::pressed [-]; threshold: high_sliding_pressure
    nothing_touched,        ///< note: the distance of the two that were nearest at the end [m]
    erosion,                ///< share of mass or energy that cells took along which left [-]; threshold: large_eroded_share
    splits,                 ///< size of Losses::at_splits over the energy in play [-]; threshold: large_split_share
    fracture_energy,        ///< fracture_error [-]; threshold: large_fracture_error
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
        threshold;  ///< above which (unseen_edges, missing_bond, short_cohesive_length, slow_cell, missing_inertia, alternating_slip: below which) `value` is worth a word
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
