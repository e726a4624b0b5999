#pragma once
#include <nlohmann/json.hpp>

#include <functional>
#include <string>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "support/run_options.hpp"

namespace abut::examples {

/// What is run: bodies, what they are made of, and how they move at the start.
template <int Dim>
struct Scene {
    std::string program{};                         ///< that makes the scene
    mesh::Mesh<Dim> mesh{};
    std::vector<dynamics::Material> materials{};   ///< one a body
    std::vector<Vector<Dim>> velocity{};           ///< at the start, one a body [m/s]
    double time = 0.0;                             ///< end of the run [s]
    std::string remedy_if_overlapping{};           ///< ends the message if bodies overlap at the start
    nlohmann::ordered_json options{};              ///< the scene's own, for the summary
    double mesh_seconds = 0.0;                     ///< what making the mesh took [s]
};

/// Where the time of a run went [s].
struct RunSeconds {
    double total = 0.0;    ///< without the mesh
    double setup = 0.0;    ///< check for overlapping bodies, operators, stable step
    double ledger = 0.0;
    double output = 0.0;   ///< energy.csv, frames, picture
};

/// A finished run.
template <int Dim>
struct RunResult {
    dynamics::Ledger<Dim> ledger;
    dynamics::StableStep stable;
    double dt = 0.0;                             ///< [s]
    std::int64_t steps = 0;
    contact::ContactReport contact;
    std::int64_t candidates_max = 0;             ///< largest candidate list at a record
    dynamics::StencilReport stencils;
    std::vector<dynamics::BodyMotion<Dim>> start;
    std::vector<dynamics::BodyMotion<Dim>> end;
    dynamics::SolidTimes times;
    RunSeconds seconds;
    std::string without_picture;                 ///< why there is none; empty: there is
};

/// Runs the scene and leaves energy.csv, energy.gp, energy.png, the VTU series and summary.json in `options.out`; results of
/// an earlier run there are removed before it starts. The closing table goes to standard output.
/// Throws std::exception with place, value, limit and remedy: folder not writable, bodies that overlap, time step above the
/// stable one, divergence. No energy.csv and no summary.json is left then.
template <int Dim>
void run(const Scene<Dim>& scene, const RunOptions& options);

/// The body of a main function: calls `program`, and ends with one message on standard error, and 1, if it throws.
int report_errors(const std::string& name, const std::function<void()>& program);

}  // namespace abut::examples
