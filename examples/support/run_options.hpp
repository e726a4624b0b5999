#pragma once
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>

#include "abut/contact/options.hpp"
#include "abut/dynamics/boundary_conditions.hpp"

namespace abut::examples {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// How a scene is run: what all examples share.
struct RunOptions {
    double time = not_given;         ///< end of the run [s]; not given: the scene's own
    double cfl = 0.9;                ///< time step over the stable step [-]
    double dt = not_given;           ///< time step [s], instead of `cfl`
    bool allow_unstable = false;
    contact::ContactOptions contact;
    dynamics::Neumann neumann = dynamics::Neumann::local_equilibrium;
    bool filter = false;             ///< energy-neutral filter of the parasitic mode
    int threads = 0;                 ///< 0: all
    std::filesystem::path out;
    int interval = 0;                ///< steps between ledger records; 0: 1 in 2D, 10 in 3D
    int frames = 21;                 ///< of the VTU series, the first and the last included; 0: none
};

/// Adds the options to a program; `default_of_time` says in --help what the end of the run is by default.
void add_run_options(CLI::App& app, RunOptions& options, const std::string& default_of_time);

/// The options as they were used, by the names of the command line.
[[nodiscard]] nlohmann::ordered_json to_json(const RunOptions& options);

}  // namespace abut::examples
