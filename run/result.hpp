#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "abut/contact/report.hpp"
#include "abut/contact/surface/blind_corners.hpp"
#include "abut/contact/surface/unseen_edges.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/unjoined_faces.hpp"
#include "abut/run/options.hpp"
#include "abut/run/values/accounts.hpp"
#include "abut/run/values/body_sliding.hpp"
#include "abut/run/values/energy_scale.hpp"
#include "abut/run/values/erosion_report.hpp"
#include "abut/run/values/pilot_report.hpp"
#include "abut/run/values/rebalancing.hpp"
#include "abut/run/values/settling_report.hpp"
#include "abut/run/values/sightings.hpp"
#include "abut/run/values/sliding_windows.hpp"
#include "abut/run/values/surface_looks.hpp"
#include "abut/run/values/value.hpp"
#include "abut/solid/body_inertia.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/fragments.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {

/// Steps of a run.
struct RunSteps {
    dynamics::StableStep stable;
    double dt = 0.0;                         ///< [s]
    double finest_dt = 0.0;                  ///< of the finest cells; dt itself except with memm_async [s]
    std::vector<std::int64_t> level_cells;   ///< cells that step with dt, dt/2, ... (memm_async); empty: all with dt
    std::int64_t evaluations = 0;            ///< forces of cells, in the steps
    std::int64_t steps = 0;                  ///< to the end; taken, once the run has ended
    std::int64_t resumed_after = 0;          ///< the step of the checkpoint that this run went on from; 0: none
    bool complete = true;                    ///< false: an observer asked to stop before the last step
    int threads = 0;                         ///< allowed
    std::optional<PilotReport> pilot;        ///< under BodyKinematics::automatic
    std::optional<SettlingReport> settling;  ///< under RunOptions::settle
};

/// Scales of the energy and the momentum of a run, and what changes them.
template <int Dim>
struct RunEnergy {
    Accounts<Dim> accounts;
    EnergyScale scale;            ///< with its value, 0 as long as nothing has moved
    double at_rest = 0.0;         ///< up to which nothing has moved: what rounding makes of bodies at rest [J]
    double fine_max = 0.0;        ///< largest kinetic energy of motion from cell to cell, at about 40 records [J]
    dynamics::Losses dissipated;  ///< by materials in all steps: Solid::dissipated
    std::vector<std::string> forces_from_outside;   ///< "supports", "gravity" and so on: change momentum; empty: nothing
    std::vector<std::string> moments_from_outside;  ///< the same of angular momentum
    bool accounts_for_outside = false;              ///< Accounts::momentum_drift leaves out all that they have given
    /// Scale where J~ is conserved: times the root of an energy it is a bound of the angular momentum [kg^(1/2) m]; else 0
    double moment_scale = 0.0;
};

/// Contact in a run.
template <int Dim>
struct RunContact {
    contact::ContactReport report;
    solid::ContactLaw asked_law = solid::ContactLaw::automatic;
    double skin = 0.0;                           ///< of the last candidate list [m]
    std::int64_t inadmissible_overlaps_max = 0;  ///< largest number of `inadmissible_overlaps` at any record
    std::vector<double> overlaps;                ///< at the start, of each of SolidOptions::interference [m]
    SlidingWindows sliding;
    std::vector<contact::BlindCorner<Dim>> blind_corners;  ///< too sharp for contact to see them
    std::optional<contact::EdgePair<Dim>> unseen_edges;    ///< that would cross without contact
};

/// Bodies of a run.
template <int Dim>
struct RunBodies {
    std::vector<solid::BodyMotion<Dim>> start;
    std::vector<solid::BodyMotion<Dim>> end;
    std::vector<solid::BodyInertia<Dim>> inertia;  ///< empty except on the first rank
    bool all_may_turn = false;                     ///< no body is of Kinematics::small
    std::vector<bool> may_turn;                    ///< which bodies are not
    bool finite_kinematic_hardening = false;       ///< a body of finite strains hardens kinematically
    solid::FiniteExtremes finite;                  ///< of all steps: Solid::finite_extremes
    std::vector<double> local_rotations;           ///< at the end: Solid::local_rotations [rad]
    solid::StencilReport stencils;                 ///< of the faces between cells
    solid::StencilReport boundary_stencils;        ///< of the boundary faces that local equilibrium leaves undetermined
    mesh::UnjoinedFaces unjoined;                  ///< within bodies, at the start; on several ranks known to rank 0
};

/// Bonds of a run.
template <int Dim>
struct RunBonds {
    std::vector<solid::BondCoverage> coverage;    ///< of each of SolidOptions::bonds
    std::vector<solid::Fragment<Dim>> fragments;  ///< at the end; empty where no bond may break
    double broken_share = 0.0;                    ///< BondView::broken_share at the end [-]
    double beyond_fracture_energy = 0.0;          ///< BondView::beyond_fracture_energy at the end [J]
};

/// Observations that warnings come from.
template <int Dim>
struct RunWatch {
    SurfaceLooks looks;             ///< at the surfaces of the bodies
    Sightings<Dim> sightings;       ///< at records; on rank 0 all of them
    TurnedBody turned;              ///< at any record, of bodies that may not turn
    WeakFriction weak_friction;     ///< of bodies that slide, with the longest time
    Compressed compressed;          ///< bodies pressed into each other deepest, until the last record
    std::vector<Finding> findings;  ///< of the scene
};

/// Time that the parts of a run took [s].
struct RunSeconds {
    double total = 0.0;
    double mesh = 0.0;   ///< making or reading it; known only to whoever did
    double setup = 0.0;  ///< check for overlapping bodies, operators, stable step
    double ledger = 0.0;
    double output = 0.0;      ///< of ResultFiles
    double looks = 0.0;       ///< at the surfaces (SurfaceLooks), that at the end not counted
    solid::SolidTimes solid;  ///< of the steps
};

/// A finished run, or one that is under way.
template <int Dim>
struct RunResult {
    RunOptions options;  ///< with the defaults filled in, the law of contact that acts among them
    dynamics::Ledger<Dim> ledger;
    RunSteps run;
    RunEnergy<Dim> energy;
    RunContact<Dim> contact;
    RunBodies<Dim> bodies;
    RunBonds<Dim> bonds;
    ErosionReport<Dim> erosion;  ///< cells that have left
    RunWatch<Dim> watch;
    Rebalancing rebalancing;  ///< on several ranks
    RunSeconds seconds;
};

}  // namespace abut::run
