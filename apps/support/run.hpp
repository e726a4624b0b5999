#pragma once
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/solid/body_motion.hpp"
#include "apps/support/finding.hpp"
#include "apps/support/program.hpp"
#include "apps/support/run_options.hpp"

namespace abut::examples {

/// What the energies of a run are measured with.
struct EnergyScale {
    std::string name = "K0";  ///< a letter and its index
    double value = 0.0;       ///< [J]; 0: the kinetic energy at the start
};

template <int Dim>
struct RunResult;

/// What is run: bodies, what they are made of, what acts on them, and how they move at the start.
template <int Dim>
struct Scene {
    mesh::Mesh<Dim> mesh{};
    solid::SolidOptions<Dim> solid{};     ///< all but the choices of RunOptions: contact and Neumann
    std::vector<Vector<Dim>> velocity{};  ///< at the start, one a body [m/s]
    std::function<Vector<Dim>(const Vector<Dim>& position)> displacement{};  ///< at the start [m]; empty: none
    bool contact = true;                  ///< false: bodies pass through each other, at no cost
    double time = 0.0;                    ///< end of the run where no option says it [s]
    EnergyScale energy_scale{};           ///< to be given where all is at rest at the start
    std::string remedy_if_overlapping{};  ///< ends the message if bodies overlap at the start
    nlohmann::ordered_json options{};     ///< the scene's own, as they were used
    std::function<void(const solid::Solid<Dim>&, double dt)> after_step{};  ///< looks on; may be empty
    std::function<std::vector<Finding>(const RunResult<Dim>&)> findings{};  ///< at the end; may be empty
};

/// Where the time of a run went [s].
struct RunSeconds {
    double total = 0.0;
    double mesh = 0.0;   ///< making or reading it
    double setup = 0.0;  ///< check for overlapping bodies, operators, stable step
    double ledger = 0.0;
    double output = 0.0;  ///< energy.csv, frames, picture
};

/// A finished run.
template <int Dim>
struct RunResult {
    dynamics::Ledger<Dim> ledger;
    dynamics::StableStep stable;
    double dt = 0.0;                        ///< [s]
    double finest_dt = 0.0;                 ///< of the finest cells; dt itself but with memm_async [s]
    std::vector<std::int64_t> level_cells;  ///< cells that step with dt, dt/2, ... (memm_async); empty: all with dt
    std::int64_t evaluations = 0;           ///< forces of cells, in the steps
    std::int64_t steps = 0;
    EnergyScale scale;  ///< with its value, > 0
    double skin = 0.0;  ///< of the last candidate list [m]
    int threads = 0;    ///< allowed
    contact::ContactReport contact;
    std::int64_t not_admitted_max = 0;        ///< most pairs at a record that face each other inside and are no contacts
    std::vector<Vector<Dim>> blind_corners;   ///< too sharp for contact to see them [m]
    std::int64_t contact_faces_left_out = 0;  ///< their displacement is prescribed
    solid::StencilReport stencils;            ///< of the faces between cells
    solid::StencilReport boundary_stencils;   ///< of the boundary faces that local equilibrium leaves undetermined
    std::vector<solid::BodyMotion<Dim>> start;
    std::vector<solid::BodyMotion<Dim>> end;
    solid::SolidTimes times;  ///< of the steps
    RunSeconds seconds;
    std::vector<Finding> findings;  ///< of the scene
    std::string without_picture;    ///< why there is none; empty: there is
};

/// Makes the scene, runs it, and leaves energy.csv, energy.gp, energy.png, the VTU series and summary.json in `options.out`.
/// Results of an earlier run there are removed first, before anything can be refused. The closing table goes to standard
/// output. Throws std::exception with place, value, limit and remedy: folder not writable, unusable mesh, bodies that
/// overlap, time step above the stable one, divergence. No energy.csv and no summary.json is left then.
template <int Dim>
void run(const Program& program, const RunOptions& options, const std::function<Scene<Dim>()>& make_scene);

}  // namespace abut::examples
