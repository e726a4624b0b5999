// What a faster setting costs, and what a slower one gives: the same few scenes over the ladder of all choices.
//
// Each setting, as it would be typed, is run on each mesh of each problem: two cylinders that slip (2D, 3D), two discs that
// turn before they meet, a cylinder on a block at rest, a bar that hits a wall. The table has five errors beside the
// seconds: drift of H~, error of the true energy H, of the restitution, of the velocity after an impact, of the contact
// pressure. Round bodies are run with finite elements and contact on their nodes, too ("nodes"), on the same meshes. A
// run is on the front where no other one of its problem is as fast and as good. docs/trade.md reads the table; the
// presets of the other programs follow from it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "abut/base/error.hpp"
#include "abut/run/files/files.hpp"
#include "abut/run/files/folder_lock.hpp"
#include "apps/support/preset.hpp"
#include "studies/program/entry.hpp"
#include "studies/table/table.hpp"
#include "studies/trade/report.hpp"

namespace abut::studies::trade {
namespace {

const apps::Program program{
    .name = "trade",
    .purpose = "Error against seconds, for all choices that trade one for the other.",
    .footer =
        "Seconds are those of the steps, least of --repetitions. Shared machines are noisy: trust ratios of two, not "
        "of one and a tenth."};

const apps::Choices<Extent> extents = {
    {"each", Extent::each}, {"kinematics", Extent::kinematics}, {"products", Extent::products}};

struct Options {
    std::vector<std::string> only;
    Extent extent = Extent::each;
    std::vector<Setting> settings;  ///< of the user, beside the ladder
    int levels = 0;                 ///< coarsest meshes of each problem; 0: all
    int repetitions = 1;
    double limit = 120.0;  ///< of a run [s]
    std::filesystem::path out = "out/" + program.name;
};

/// Why no program would take a setting; empty if one would.
std::string refusal(const Setting& setting) {
    try {
        run::RunOptions run;
        apps::apply_words(setting, run);
        return "";
    } catch (const BadInput& error) {
        return error.what();
    }
}

void add_options(Flags& flags, Options& options) {
    flags.group("Ladder");
    flags.names("--only", options.only, "problems to run", names_of(problems()));
    flags.choice("--settings", options.extent,
                 "each choice by itself, kinematics and presets alone, or products of choices that act together, too",
                 extents);
    flags.lines("--also", options.settings,
                "a setting of your own, in quotation marks: \"--cfl 0.5 --events off\"; may come again; by default none",
                refusal);
    flags.count("--levels", options.levels, "coarsest meshes of each problem; 0: all", 0);
    flags.count("--repetitions", options.repetitions, "of each run, in turn; the least time counts", 1);
    flags.number("--limit", options.limit,
                 "of a run in time; one that takes longer is stopped, and said to be. Not of the references",
                 {.unit = "s", .above = 0.0});
    flags.out(options.out);
}

run::NamedValues named_values(const Options& options) {
    return {{"only", options.only},     {"settings", apps::name_of(extents, options.extent)},
            {"also", options.settings}, {"levels", options.levels},
            {"limit", options.limit},   {"repetitions", options.repetitions}};
}

/// Runs it; every exception becomes a row.
Row attempt(const Problem& problem, int level, const Setting& setting, const Reference& reference, double limit) {
    Row row{.problem = problem.name, .level = level, .setting = setting};
    const std::vector<NodalSetting> nodal = nodal_ladder(problem.motion);
    const auto on_nodes = std::ranges::find(nodal, setting, &NodalSetting::setting);
    try {
        if (on_nodes != nodal.end()) {
            row.model = model_of(on_nodes->run);
            row.outcome = problem.solve_on_nodes(on_nodes->run, level, reference, limit);
        } else {
            run::RunOptions run = problem.base;
            apps::apply_words(setting, run);
            row.model = model_of(run);
            row.outcome = problem.solve(run, level, reference, limit);
        }
    } catch (const std::exception& error) {
        row.refusal = error.what();
    }
    return row;
}

/// Settings of the ladder, then those of the user, then those of another host.
std::vector<Setting> settings_of(const Problem& problem, const Options& options) {
    std::vector<Setting> settings = ladder(options.extent, problem.motion);
    for (const Setting& setting : options.settings)
        if (std::ranges::find(settings, setting) == settings.end()) settings.push_back(setting);
    if (problem.solve_on_nodes)
        for (const NodalSetting& on_nodes : nodal_ladder(problem.motion)) settings.push_back(on_nodes.setting);
    return settings;
}

/// By runs of their own, where there are no exact values.
Reference reference_of(const Problem& problem) {
    if (!problem.reference) return {};
    const Reference reference = problem.reference();
    if (!std::isnan(reference.restitution)) fmt::print("  restitution {:.6f}, --preset exact\n", reference.restitution);
    fmt::print("  velocity {:.6f}, on nodes with the filter\n", fmt::join(reference.velocity, " "));
    return reference;
}

std::vector<Row> climb(const Problem& problem, const Options& options) {
    print_head(problem);
    const std::vector<Setting> settings = settings_of(problem, options);
    const Reference reference = reference_of(problem);
    std::vector<int> levels = problem.levels;
    if (options.levels > 0) levels.resize(std::min(levels.size(), static_cast<std::size_t>(options.levels)));
    std::vector<Row> rows;
    for (const int level : levels) {
        const std::size_t first = rows.size();
        for (const Setting& setting : settings) rows.push_back(attempt(problem, level, setting, reference, options.limit));
        for (int i = 1; i < options.repetitions; ++i)
            for (std::size_t row = first; row < rows.size(); ++row) {
                if (!rows[row].finished()) continue;
                const Row again = attempt(problem, level, rows[row].setting, reference, options.limit);
                if (again.finished())
                    rows[row].outcome.seconds_of_steps =
                        std::min(rows[row].outcome.seconds_of_steps, again.outcome.seconds_of_steps);
            }
        for (std::size_t row = first; row < rows.size(); ++row) print(rows[row]);
    }
    return rows;
}

void run(const Options& options) {
    const run::FolderLock lock(options.out, program.name);
    run::claim_results(options.out, {"trade.csv", "summary.json", "pareto.gp", "pareto.png"});
    std::vector<Row> rows;
    for (const Problem& problem : problems()) {
        if (!asks_for(options.only, problem.name)) continue;
        for (Row& row : climb(problem, options)) rows.push_back(std::move(row));
    }
    compare(rows);
    write_report(program, options.out, named_values(options), rows);
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run));

}  // namespace

}  // namespace abut::studies::trade
