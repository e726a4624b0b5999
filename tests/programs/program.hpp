#pragma once
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace abut::test::programs {

/// A folder for this process alone, since CTest runs the cases side by side; empty at first, removed with the object.
class Folder {
public:
    explicit Folder(const std::string& name);
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// What a run of a program left behind.
struct Outcome {
    int exit_code;                    ///< -1 if a signal ended it
    std::string out;                  ///< standard output
    std::string error;                ///< standard error
    std::filesystem::path directory;  ///< of the results; gone with the last copy of the outcome
    std::shared_ptr<const Folder> folder;
};

/// Runs a program in the shell: `program` is its name, or "study hertz"; `arguments` are passed on, with --out to an empty folder of that
/// name. With an empty folder name the arguments hold their own --out, if any. `before` goes in front: "PATH=/nowhere".
[[nodiscard]] Outcome run_program(const std::string& program, const std::string& arguments, const std::string& folder,
                                  const std::string& before = "");

/// The same, and the exit code has to be 0.
[[nodiscard]] Outcome run_well(const std::string& program, const std::string& arguments, const std::string& folder,
                               const std::string& before = "");

/// Arguments of abut that run scenes/slipping_cylinders.toml, and its scene in 3D, with more options.
[[nodiscard]] std::string slip(const std::string& options);
[[nodiscard]] std::string slip_3d(const std::string& options);

/// Arguments of abut that run two bodies of two mesh files, which fly towards each other along x, with more options. Writes the
/// scene beside the first file.
[[nodiscard]] std::string two_meshes(int dim, const std::filesystem::path& left, const std::filesystem::path& right,
                                     const std::string& options);

/// Throws std::runtime_error if the file is missing.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);
[[nodiscard]] nlohmann::json read_summary(const Outcome& outcome);

/// A number that summary.json of a comparison holds of a scheme: figure(outcome, "memm", "seconds").
[[nodiscard]] double figure(const Outcome& outcome, const std::string& scheme, const std::string& name);

/// What summary.json of a study holds of a quantity at a level. Throws std::runtime_error if there is none of that name.
struct StudyQuantity {
    double value;
    double reference;
    double error;
};
[[nodiscard]] StudyQuantity study_quantity(const Outcome& outcome, std::size_t level, const std::string& name);

/// Every quantity of a study that has a target has to meet it; how many there are, at all levels together.
int check_targets(const Outcome& outcome);

/// Names of all files in a folder, in order, except the one that makes it a folder of results.
[[nodiscard]] std::vector<std::string> files_in(const std::filesystem::path& directory);

/// A file of results: names of the columns, without their units, and all rows.
struct Table {
    std::vector<std::string> columns;
    std::vector<std::vector<double>> rows;
    [[nodiscard]] std::vector<double> column(const std::string& name) const;
};
[[nodiscard]] Table read_table(const Outcome& outcome, const std::string& file);
[[nodiscard]] Table read_energies(const Outcome& outcome);  ///< energy.csv

/// Largest |H~ - H~0| over K0, or what else the run measures energies with.
[[nodiscard]] double relative_drift(const Outcome& outcome);

}  // namespace abut::test::programs
