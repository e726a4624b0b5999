#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <optional>

#include "abut/run/files/files.hpp"
#include "abut/run/files/folder_lock.hpp"
#include "studies/program/flags.hpp"
#include "studies/table/columns.hpp"
#include "studies/table/figures.hpp"
#include "studies/table/study.hpp"

/// Studies in parts, each of which gives rows of a table as it goes on.
namespace abut::studies {

/// A part of a study: it gives its rows to a sink, one by one.
template <class Options, class Row>
struct Part {
    std::string name;
    std::string question;
    std::function<void(const Options&, const std::function<void(const Row&)>&)> run;
};

/// Names of parts, of problems, of scenes.
template <class Parts>
[[nodiscard]] std::vector<std::string> names_of(const Parts& parts) {
    std::vector<std::string> names;
    for (const auto& part : parts) names.push_back(part.name);
    return names;
}
/// Whether a name is among those that were asked for; none stands for all.
[[nodiscard]] bool asks_for(const std::vector<std::string>& only, const std::string& name);

/// Runs the parts that are asked for; prints the head of each, and its rows as they come. All rows.
template <class Options, class Row>
[[nodiscard]] std::vector<Row> run_parts(const std::vector<Part<Options, Row>>& parts, const std::vector<std::string>& only,
                                         const Options& options, const std::string& heads,
                                         const std::function<void(const Row&)>& print) {
    std::vector<Row> rows;
    for (const auto& part : parts) {
        if (!asks_for(only, part.name)) continue;
        fmt::print("{}: {}\n  {}\n", part.name, part.question, heads);
        part.run(options, [&](const Row& row) {
            print(row);
            std::fflush(stdout);
            rows.push_back(row);
        });
    }
    return rows;
}

/// Options of a study in parts: --only, --quick, --out.
struct PartOptions {
    std::vector<std::string> only;  ///< parts to run; empty: all
    bool quick = false;             ///< coarse meshes and short runs
    std::filesystem::path out;      ///< folder of all results
};
void add_part_options(Flags& flags, const apps::Program& program, const std::vector<std::string>& parts,
                      PartOptions& options);

/// A name as that of a folder.
[[nodiscard]] std::string folder_name(std::string name);

/// A row of scenes in settings: a run, or a solution at rest.
struct Row {
    std::string scene;
    std::string setting;
    std::optional<Figures> run = {};
    Quantities quantities = {};  ///< with a target, or worth saying
    std::string remark = {};
    double seconds = 0.0;
};
using Sink = std::function<void(const Row&)>;

/// The laws that a run has to meet, whatever its scene is.
struct Laws {
    bool pseudo = true;      ///< H~ and J~ are kept; false: of central differences, angular momentum instead of J~
    bool turns = true;       ///< bodies may turn, so that it is
    double angular = 1e-13;  ///< allowed drift of either
};
/// A row of a run with the quantities that every run has to meet: that it comes to its end, missed contacts, H~,
/// corrections, and what nothing from outside changes.
[[nodiscard]] Row row_of(const std::string& scene, const std::string& setting, const Figures& run, int dim,
                         const Laws& laws = {});

/// How wide the columns of a table of such rows are, and what it does not show of Figures.
struct RowTable {
    int scene = 20, setting = 28, dt = 9;  ///< characters
    std::vector<std::string> without{};    ///< keys of columns

    [[nodiscard]] Columns<Figures> columns() const;
};

void print(const Row& row, const RowTable& table);
/// Leaves <program>.csv, one line per quantity, and summary.json; prints how many rows miss a target.
void write_rows(const apps::Program& program, const std::filesystem::path& out, const run::NamedValues& options,
                const std::vector<Row>& rows, const RowTable& table);

/// A study in parts: runs them, prints its table and leaves its files. `used` are the options for the summary.
template <class Options>
void run_study_in_parts(const apps::Program& program, const std::vector<Part<Options, Row>>& parts, const Options& options,
                        const run::NamedValues& used, const RowTable& table) {
    const run::FolderLock lock(options.out, program.name);
    run::claim_results(options.out, {"summary.json", program.name + ".csv"});
    const std::string all_heads = shown("", -table.scene) + shown("", -table.setting) + heads(table.columns());
    const auto rows =
        run_parts<Options, Row>(parts, options.only, options, all_heads, [&](const Row& row) { print(row, table); });
    write_rows(program, options.out, used, rows, table);
}

}  // namespace abut::studies
