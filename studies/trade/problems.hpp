#pragma once
#include <functional>
#include <string>
#include <vector>

#include "studies/trade/errors.hpp"
#include "studies/trade/ladder.hpp"
#include "studies/trade/nodal.hpp"

namespace abut::studies::trade {

/// Reference against which errors are measured, where there is no exact value.
struct Reference {
    double restitution = run::not_given;  ///< of the cell-centred solid on a finer mesh, under its default law
    std::vector<double> velocity = {};    ///< of the left body at the end (Dim), of finite elements on that mesh [m/s]
};

/// A scene whose error can be told, on meshes of several sizes.
struct Problem {
    std::string name;
    std::string text;  ///< what it is, what its errors are measured against
    Motion motion = Motion::translating;
    run::RunOptions base{};   ///< what it needs beside the defaults; a setting overrules it
    std::vector<int> levels;  ///< cells in the radius, in the contact radius or along the bar, coarse to fine
    std::function<Reference()> reference = {};  ///< finds it, by runs of its own; empty: there are exact values
    /// Runs it. Throws as `simulate`, and std::runtime_error where a run in time takes longer than `limit` [s].
    std::function<Outcome(const run::RunOptions& run, int level, const Reference& reference, double limit)> solve;
    /// The same scene with finite elements and contact on their nodes; empty: there is none.
    std::function<Outcome(const NodalRun& run, int level, const Reference& reference, double limit)> solve_on_nodes = {};
};

[[nodiscard]] const std::vector<Problem>& problems();

}  // namespace abut::studies::trade
