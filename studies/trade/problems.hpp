#pragma once
#include <functional>
#include <string>
#include <vector>

#include "studies/trade/errors.hpp"
#include "studies/trade/nodal.hpp"

namespace abut::studies::trade {

/// A scene whose error can be told, on meshes of several sizes.
struct Problem {
    std::string name;
    std::string text;         ///< what it is, what its errors are measured against
    bool at_rest = false;     ///< solved by statics: no scheme in time, no drift
    run::RunOptions base{};   ///< what it needs beside the defaults; a setting overrules it
    std::vector<int> levels;  ///< cells in the radius, in the contact radius or along the bar, coarse to fine
    int reference_level = 0;  ///< of the run that the restitution is measured against; 0: there is an exact value
    /// Runs it. `reference` is the restitution to measure against, where there is no exact one. Throws as `simulate`, and
    /// std::runtime_error where a run in time takes longer than `limit` [s].
    std::function<Outcome(const run::RunOptions& run, int level, double reference, double limit)> solve;
    /// The same scene with finite elements and contact on their nodes; empty: there is none.
    std::function<Outcome(const nodal::ImpactOptions& run, int level, double reference, double limit)> solve_on_nodes = {};
    /// Restitution by itself, of problems with a reference level.
    std::function<double(const run::RunOptions& run, int level)> restitution = {};
};

[[nodiscard]] const std::vector<Problem>& problems();

}  // namespace abut::studies::trade
