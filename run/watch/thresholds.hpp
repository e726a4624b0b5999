#pragma once
// Values from which a run warns.

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

/// E G/strength^2 over the size of a cell below which a bond opens within about one cell [-]. docs/limits.md.
inline constexpr double enough_cohesive_length = 1.0;

/// |E| above which the strain of a finite body is worth a word [-]: its material is one of small strains. docs/limits.md.
inline constexpr double large_strain = 0.2;

/// Plastic strain above which kinematic hardening of finite bodies may be another rule than of metal without it [-]: in
/// simple shear of 1, which is 0.58 of it, its stress is 3 % lower. docs/limits.md.
inline constexpr double large_kinematic_flow = 0.6;

/// The size of Losses::on_faces over `in_cells` above which free faces that flow along take more than they should [-]:
/// a bar eight cells across has 0.02, boxes three cells across that collide 0.16. A finite block that planes press far
/// beyond yield bears 5 % too much with 0.06, and 7 % with 0.12. docs/limits.md.
inline constexpr double large_face_loss = 0.05;
/// Energy that plastic flow gives back from record to record over what it has dissipated at most, above which it is told
/// [-]. Metal that is pulled, bent or rolled has none. docs/limits.md.
inline constexpr double large_returned_flow = 0.01;
/// Share of mass or of the energy in play that cells which leave may take along [-].
inline constexpr double large_eroded_share = 0.01;
/// The size of Losses::at_splits over the energy in play above which frames of fragments tell in the result [-]: plates and
/// discs whose grains come apart before they turn have less than 0.001, hard impacts 0.01 to 0.02. docs/limits.md.
inline constexpr double large_split_share = 0.01;
/// The size of what bonds dissipated beyond their fracture energy, over what they should have, above which it is told [-].
inline constexpr double large_fracture_error = 0.01;

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

}  // namespace abut::run
