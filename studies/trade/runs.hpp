#pragma once
#include "abut/run/steps/simulation.hpp"
#include "studies/trade/errors.hpp"

namespace abut::studies::trade {

/// A run in time, and what its row needs beside its ledger.
template <int Dim>
struct TimedRun {
    run::RunResult<Dim> result;
    double seconds = 0.0;  ///< of the steps: less set-up and energies
    MomentumScales scales;
};

/// On one thread, energies every tenth step: measuring them costs two evaluations of the force. Throws as `simulate`, and
/// std::runtime_error where it takes longer than `limit` [s].
template <int Dim>
[[nodiscard]] TimedRun<Dim> run_for(const run::Scene<Dim>& scene, run::RunOptions run, double limit);

/// All except the errors of what the problem is about; `speed` is that of the impact [m/s]. Momentum and J~ are of bodies
/// that nothing holds.
template <int Dim>
[[nodiscard]] Outcome outcome_of(const run::Scene<Dim>& scene, const TimedRun<Dim>& timed, double speed);

}  // namespace abut::studies::trade
