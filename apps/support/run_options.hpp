#pragma once
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <string>

#include "abut/contact/options.hpp"
#include "abut/solid/boundary_conditions.hpp"

namespace abut::examples {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// The schemes that a solid with contact runs under. docs/integrators.md says which to choose.
enum class SolidIntegrator { memm, memm_async, leapfrog, bilbao };

/// How a scene is run: what all examples share.
struct RunOptions {
    double time = not_given;  ///< end of the run [s]; not given: as many steps as `steps`, or the scene's own time
    int steps = 0;            ///< of the run where no time is given; 0: not given
    double cfl = 0.9;         ///< time step over the stable step [-]
    double dt = not_given;    ///< time step [s], instead of `cfl`
    bool allow_unstable = false;
    contact::ContactOptions contact;
    solid::FreeFaceRule neumann = solid::FreeFaceRule::local_equilibrium;
    SolidIntegrator integrator = SolidIntegrator::memm;
    int levels = 0;            ///< of memm_async, at most; 0: 8
    int contact_margin = 1;    ///< of memm_async: levels that cells in contact are finer than they need to be alone
    int contact_levels = 0;    ///< of memm_async: levels that cells in contact are finer than all others
    double gauge = not_given;  ///< c of the Bilbao scheme [J]; not given: the energy at the start
    bool filter = false;       ///< energy-neutral filter of the parasitic mode
    int threads = 0;           ///< 0: all
    std::filesystem::path out;
    int interval = 0;  ///< steps between ledger records; 0: 1 in 2D, 10 in 3D
    int frames = 21;   ///< of the VTU series, the first and the last included; 0: none
};

/// As on the command line: "memm".
[[nodiscard]] std::string name_of(SolidIntegrator integrator);

/// Groups of options; their defaults are the present values of `options`. `default_of_time` says in --help what the end of
/// the run is by default.
void add_time_options(CLI::App& app, RunOptions& options, const std::string& default_of_time);
void add_contact_options(CLI::App& app, RunOptions& options);
void add_model_options(CLI::App& app, RunOptions& options);  ///< of these, what bodies at rest depend on, too
void add_compression_limit(CLI::App& app, RunOptions& options);
void add_output_options(CLI::App& app, RunOptions& options);

/// The options as given, by the names of the command line: either --dt or --cfl, whichever decided. Of the end of the run,
/// skin and threads only the run knows what they were.
[[nodiscard]] nlohmann::ordered_json to_json(const RunOptions& options);
[[nodiscard]] nlohmann::ordered_json model_json(const RunOptions& options);  ///< of `add_model_options` alone

}  // namespace abut::examples
