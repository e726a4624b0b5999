#pragma once
#include <nlohmann/json.hpp>

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "abut/run/folder_lock.hpp"
#include "abut/run/scene.hpp"
#include "apps/support/csv.hpp"
#include "apps/support/gnuplot.hpp"
#include "apps/support/program.hpp"
#include "apps/support/run_options.hpp"

namespace abut::studies {

/// A number that a computation gave, beside what it should be.
struct Quantity {
    std::string name;  ///< "mean pressure"; the same at every level of a study
    std::string unit;  ///< "" for a ratio
    double value;
    double reference;  ///< exact, or of the source that the program names
    /// What the error is divided by, in the same unit; 0: |reference|
    double scale = 0.0;
    /// Largest error that counts as reproduced [-]; infinite: none is asked for at this level
    double allowed = std::numeric_limits<double>::infinity();

    /// |value - reference| / scale [-]
    [[nodiscard]] double error() const;
    [[nodiscard]] bool has_target() const { return allowed < std::numeric_limits<double>::infinity(); }
    [[nodiscard]] bool is_met() const { return error() <= allowed; }
};
/// Value, reference, error, and whether it is met; what is not finite is null.
[[nodiscard]] nlohmann::ordered_json to_json(const Quantity& quantity);

/// What stands beside every claim about energy. docs/method.md, Time.
struct EnergyFigures {
    double drift;      ///< max |H~ - H~0 - work| over `scale` [-]
    double excess;     ///< max (H - H~) over `scale` [-]
    double parasitic;  ///< max |e|/m [m/s]
    std::int64_t events;
    double scale;  ///< [J]
    std::string scale_name;
};
template <int Dim>
[[nodiscard]] EnergyFigures energy_figures(const run::RunResult<Dim>& result);

/// One computation of a study.
struct Level {
    std::string name;   ///< "100 cells"
    double size = 0.0;  ///< of a cell [m], for the order of convergence; 0: not part of a refinement
    std::vector<Quantity> quantities;
    std::optional<EnergyFigures> energies;  ///< of a run
    double seconds = 0.0;                   ///< of the computation, with its set-up
};

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
    std::vector<apps::Picture> pictures;
    nlohmann::ordered_json options;  ///< as they were used
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
