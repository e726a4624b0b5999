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
        if (run.steps == 0) take_scales(run, solid);
        const std::chrono::duration<double> waited = Clock::now() - begin_;
        if (waited.count() > limit_)
            throw std::runtime_error(fmt::format("stopped at step {}, t = {:.4g} s: --limit of {:g} s per run is over",
                                                 run.steps, run.time, limit_));
    }

private:
    void take_scales(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
        const auto q = as_vectors<Dim>(run.q);
        for (std::size_t i = 0; i < q.size(); ++i) {
            const Vector<Dim> p = run.momentum(static_cast<std::ptrdiff_t>(i));
            timed_.momentum_scale += p.norm();
            timed_.moment_scale += moment<Dim>(Vector<Dim>(solid.rest_positions()[i] + q[i]), p).norm();
        }
    }

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
    const run::RunResult<Dim>& result = timed.result;
    const dynamics::Ledger<Dim>& ledger = result.ledger;
    const double scale = result.scale.value;
    const bool is_free = scene.solid.obstacles.empty();
    return {.errors = {.drift = ledger.pseudo_energy_drift() / scale, .energy = ledger.energy_drift() / scale},
            .excess = ledger.energy_excess() / scale,
            .parasitic = ledger.parasitic() / speed,
            .momentum = is_free ? ledger.momentum_drift() / timed.momentum_scale : run::not_given,
            .pseudo_angular = is_free ? ledger.pseudo_angular_momentum_drift() / timed.moment_scale : run::not_given,
            .events = result.contact.events,
            .missed_contacts = result.contact.missed_contacts,
            .cells = scene.mesh.n_cells(),
            .steps = result.steps,
            .seconds = timed.seconds};
}

#define ABUT_INSTANTIATE(Dim)                                                             \
    template TimedRun<Dim> run_for<Dim>(const run::Scene<Dim>&, run::RunOptions, double); \
    template Outcome outcome_of<Dim>(const run::Scene<Dim>&, const TimedRun<Dim>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::studies::trade
