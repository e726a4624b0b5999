#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace abut::examples::test {

/// What a run of an example left behind.
struct Outcome {
    int exit_code;
    std::string out;                   ///< standard output
    std::string error;                 ///< standard error
    std::filesystem::path directory;   ///< of the results
};

/// Runs an example in the shell: `program` is its name, `arguments` are passed on, with --out to an empty folder of that name.
/// With an empty folder name the arguments hold their own --out, if any. `environment` goes in front: "PATH=/nowhere".
[[nodiscard]] Outcome run_program(const std::string& program, const std::string& arguments, const std::string& folder,
                                  const std::string& environment = "");

/// The same, and the exit code has to be 0.
[[nodiscard]] Outcome run_well(const std::string& program, const std::string& arguments, const std::string& folder,
                                  const std::string& environment = "");

/// Throws std::runtime_error if the file is missing.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);
[[nodiscard]] nlohmann::json read_summary(const Outcome& outcome);

/// energy.csv: names of the columns and all rows.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
    [[nodiscard]] std::vector<double> column(const std::string& name) const;
};
[[nodiscard]] Table read_energies(const Outcome& outcome);

}  // namespace abut::examples::test
