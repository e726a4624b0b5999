#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "abut/run/values/value.hpp"
#include "apps/support/program.hpp"
#include "studies/trade/ladder.hpp"
#include "studies/trade/problems.hpp"

namespace abut::studies::trade {

/// Model of the bodies and of what acts between them.
enum class Model { reconstruction, pair_potential, floating, rigid, nodes, finite_nodes };
[[nodiscard]] Model model_of(const run::RunOptions& run);
[[nodiscard]] Model model_of(const NodalRun& run);

/// A line of the table.
struct Row {
    std::string problem;
    int level;
    Setting setting;
    Model model = Model::reconstruction;
    Outcome outcome;
    std::string refusal;                           ///< why it did not come to its end; empty: it did
    double ratio = run::not_given;                 ///< seconds over those of the defaults on the same mesh
    std::array<bool, measures.size()> on_front{};  ///< no run of the problem is faster and not worse by this error

    [[nodiscard]] bool finished() const { return refusal.empty(); }
};

/// Fills `ratio` and `on_front` of finished runs.
void compare(std::vector<Row>& rows);

void print_head(const Problem& problem);
void print(const Row& row);

/// Leaves trade.csv, summary.json and the picture pareto.png with its script.
void write_report(const apps::Program& program, const std::filesystem::path& out, const run::NamedValues& options,
                  const std::vector<Row>& rows);

}  // namespace abut::studies::trade
