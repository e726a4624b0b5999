#pragma once
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "abut/contact/options.hpp"
#include "abut/mesh/surface_mesh.hpp"
#include "apps/support/program.hpp"

namespace abut::apps {

extern const Program detect_program;

/// Options of the command line of `abut detect`. NaN: not given.
struct DetectOptions {
    DetectOptions();

    std::vector<std::string> inputs;  ///< files and shapes
    bool connected = false;
    mesh::UnusableFaces unusable = mesh::UnusableFaces::fail;
    bool self_intersections = false;
    double planarity_tolerance = geometry::planarity_tolerance;  ///< of cells and polygons that count as flat [-]

    std::vector<std::string> translations, rotations;
    std::string script;
    std::string displacement;
    int steps = 0;  ///< 0: not given

    contact::CandidateOptions search;  ///< of these `distance` and `skin` come from the two below
    double distance, depth, skin;      ///< [m]
    geometry::AreaMethod area = geometry::AreaMethod::fast;
    double max_memory;  ///< [MB]
    double max_pairs;
    int threads = 0;

    bool verify = false;
    double verify_tests = 1e8;
    int verify_samples = 0;
    int seed = 1;

    std::filesystem::path out = "out/detect";
    bool no_files = false;
    int write_every = 0;
};

void add_options(CommandParser& parser, DetectOptions& options);
[[nodiscard]] nlohmann::ordered_json to_json(const DetectOptions& options);

}  // namespace abut::apps
