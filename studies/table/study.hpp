#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "abut/base/stopwatch.hpp"
#include "abut/run/files/folder_lock.hpp"
#include "abut/run/result.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/program.hpp"
#include "apps/support/run_options.hpp"
#include "studies/schemes/gnuplot.hpp"
#include "studies/table/figures.hpp"

namespace abut::studies {

inline constexpr double no_target = std::numeric_limits<double>::infinity();

/// A number that a computation gave, beside what it should be.
struct Quantity {
    std::string name;  ///< "mean pressure"; the same at every level of a study
    std::string unit;  ///< "" for a ratio
    double value;
    double reference;  ///< exact, or of the source that the program names
    /// Scale by which the error is divided, in the same unit; 0: |reference|
    double scale = 0.0;
    /// Largest error that counts as reproduced [-]; infinite: none is asked for at this level
    double allowed = no_target;

    /// |value - reference| / scale [-]
    [[nodiscard]] double error() const;
    [[nodiscard]] bool has_target() const { return allowed < no_target; }
    [[nodiscard]] bool is_met() const { return error() <= allowed; }
    /// `allowed`; NaN without a target
    [[nodiscard]] double target_or_nan() const { return has_target() ? allowed : run::not_given; }
};
/// Quantities of a level or of a row.
struct Quantities : std::vector<Quantity> {
    using std::vector<Quantity>::vector;
    /// A figure without a unit that is to be at most `allowed`; by default shown alone.
    void at_most(const std::string& name, double value, double allowed = no_target);
    /// A figure with a value to meet, to `allowed` of that; where that is 0, to `allowed` itself.
    void near(const std::string& name, double value, double reference, double allowed = no_target,
              const std::string& unit = "");
};
/// Value, reference, error, and whether it is met; what is not finite is null.
[[nodiscard]] nlohmann::ordered_json to_json(const Quantity& quantity);

/// One computation of a study.
struct Level {
    std::string name;   ///< "100 cells"
    double size = 0.0;  ///< of a cell [m], for the order of convergence; 0: not part of a refinement
    Quantities quantities;
    std::optional<Figures> energies;  ///< of a run
    double seconds = 0.0;             ///< of the computation, with its set-up
};

/// Result of a function, and the seconds that it took.
template <class Run>
[[nodiscard]] auto timed(double& seconds, const Run& run) {
    const Stopwatch watch(seconds);
    return run();
}

/// Numbers of cells for Study::options.
[[nodiscard]] std::vector<std::int64_t> counts(const std::vector<int>& numbers);

/// The least order of convergence that counts as reproduced.
struct OrderTarget {
    std::string quantity;
    double least;
};

/// A case with known answers, computed on finer and finer meshes, or with several choices.
struct Study {
    std::string title;
    std::string reference;  ///< where the known answers come from, a sentence
    std::vector<Level> levels;
    std::vector<std::pair<std::string, apps::Table>> curves;  ///< "pressure" is left as pressure.csv
    std::vector<Picture> pictures;
    run::NamedValues options;  ///< as they were used
    std::vector<OrderTarget> orders{};
};

/// Order p of the error ~ size^p of a quantity: least squares over the logarithms at all levels with a size and an error
/// above 1e-13. Empty where fewer than two are left.
[[nodiscard]] std::optional<double> fitted_order(const Study& study, const std::string& quantity);

/// Makes the folder and takes it for as long as the result lives, and removes what an earlier run of a study left there:
/// values.csv, summary.json, its curves and pictures.
[[nodiscard]] run::FolderLock prepare_study(const apps::Program& program, const std::filesystem::path& out,
                                            const std::vector<std::string>& curves,
                                            const std::vector<std::string>& pictures);

/// Leaves values.csv (a row a quantity and level), the curves, the pictures and summary.json; prints the table: value,
/// reference, error, target and whether it is met, orders of convergence with theirs, energies.
void report(const apps::Program& program, const std::filesystem::path& out, const Study& study);

}  // namespace abut::studies
