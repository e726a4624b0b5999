#include "studies/trade/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "abut/base/stopwatch.hpp"

namespace abut::studies::trade {
namespace {

constexpr int interval = 10;

/// Takes the scales of a run at its start, and ends one that takes too long.
template <int Dim>
class Impatience : public run::Observer<Dim> {
public:
    Impatience(TimedRun<Dim>& timed, double limit) : timed_(timed), limit_(limit) {}

    void look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) override {
        if (run.steps == 0) timed_.scales = momentum_scales<Dim>(run, solid.rest_positions());
        const std::chrono::duration<double> waited = Clock::now() - begin_;
        if (waited.count() > limit_)
            throw std::runtime_error(fmt::format("stopped at step {}, t = {:.4g} s: --limit of {:g} s per run is over",
                                                 run.steps, run.time, limit_));
    }

private:
    using Clock = std::chrono::steady_clock;
    TimedRun<Dim>& timed_;
    double limit_;
    Clock::time_point begin_ = Clock::now();
};

}  // namespace

template <int Dim>
TimedRun<Dim> run_for(const run::Scene<Dim>& scene, run::RunOptions run, double limit) {
    run.interval = interval;
    run.threads = 1;
    TimedRun<Dim> timed;
    Impatience<Dim> impatience(timed, limit);
    double all = 0.0;
    {
        const Stopwatch watch(all);
        timed.result = run::simulate<Dim>(scene, run, impatience);
    }
    timed.seconds = all - timed.result.seconds.setup - timed.result.seconds.ledger;
    return timed;
}

template <int Dim>
Outcome outcome_of(const run::Scene<Dim>& scene, const TimedRun<Dim>& timed, double speed) {
    const dynamics::Ledger<Dim>& ledger = timed.result.ledger;
    Outcome outcome{figures_of(timed.result)};
    outcome.cells = scene.mesh.n_cells();
    outcome.seconds_of_steps = timed.seconds;
    outcome.parasitic /= speed;
    if (!scene.solid.obstacles.empty()) return outcome;
    outcome.momentum = ledger.momentum_drift() / timed.scales.linear;
    outcome.pseudo_angular = ledger.pseudo_angular_momentum_drift() / timed.scales.angular;
    return outcome;
}

#define ABUT_INSTANTIATE(Dim)                                                             \
    template TimedRun<Dim> run_for<Dim>(const run::Scene<Dim>&, run::RunOptions, double); \
    template Outcome outcome_of<Dim>(const run::Scene<Dim>&, const TimedRun<Dim>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::trade
