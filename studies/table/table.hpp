#pragma once
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "apps/support/program.hpp"
#include "studies/validation/study.hpp"

/// What studies share whose parts give rows of a table: a run or a solution each, with figures and their targets.
namespace abut::studies {

class Flags;

inline constexpr double no_target = std::numeric_limits<double>::infinity();

/// A figure that is to be at most `allowed`; `no_target`: shown alone.
[[nodiscard]] Quantity at_most(const std::string& name, double value, double allowed);
/// A figure with a value to meet, to `allowed` of that.
[[nodiscard]] Quantity near(const std::string& name, double value, double reference, double allowed);

/// Options of a study in parts: --only, --quick, --out.
struct PartOptions {
    std::vector<std::string> only;  ///< parts to run; empty: all
    bool quick = false;             ///< coarse meshes and short runs
    std::filesystem::path out;      ///< folder of all results

    [[nodiscard]] bool asks_for(const std::string& part) const;
};
void add_part_options(Flags& flags, const apps::Program& program, const std::vector<std::string>& parts,
                      PartOptions& options);

/// A name as that of a folder.
[[nodiscard]] std::string folder_name(std::string name);

/// "7 met", "2 of 7 MISSED", nothing without a target.
[[nodiscard]] std::string all_met(std::span<const Quantity> quantities);
/// Prints those that are missed, or are none of `columns`, which the table has already.
void print_rest(std::span<const Quantity> quantities, std::span<const char* const> columns);

/// What a table keeps of a row when all is done.
struct RowRecord {
    std::string scene;
    std::string setting;
    std::vector<Quantity> quantities;
    nlohmann::ordered_json more = {};  ///< members beside these, for the summary
};
/// Leaves <program>.csv, one line per quantity, and summary.json; prints how many rows miss a target.
void write_table(const apps::Program& program, const std::filesystem::path& out, const nlohmann::ordered_json& options,
                 std::span<const RowRecord> rows);

}  // namespace abut::studies
