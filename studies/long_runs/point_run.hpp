#pragma once
#include <fmt/format.h>
#include <algorithm>

#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/remedies.hpp"
#include "studies/long_runs/outcome.hpp"

namespace abut::studies::long_runs {

/// H beyond this many times the scale: the solution is lost, whatever H~ says.
inline constexpr double explosion_factor = 1e3;
inline constexpr int record_interval = 101;  // prime: looks at all steps between two restarts in turn

struct PointStart {
    std::vector<double> q, p;
    double dt = 0.0;     ///< [s]
    double scale = 0.0;  ///< of energies [J]
    bool isolated = false;
};

/// Runs a host under MEMM.
template <class Host>
Outcome run_points(Host& host, const PointStart& start, const Remedy& remedy, std::int64_t steps) {
    constexpr int Dim = Host::dimension;
    dynamics::Memm memm(host, start.q, start.p, start.dt);
    dynamics::Remedies remedies(host, remedy.filter, remedy.restart);
    remedies.prepare(memm);

    const ProcessorTime time;
    dynamics::Ledger<Dim> ledger;
    const auto is_lost = [&] {
        ledger.record(dynamics::measure(memm, host, remedies.report()));
        const double gained = ledger.entries().back().energy - ledger.entries().front().pseudo_energy;
        return !(gained <= explosion_factor * start.scale);
    };
    bool lost = is_lost();
    while (memm.steps() < steps && !lost) {
        const std::int64_t until = std::min<std::int64_t>(steps, memm.steps() + record_interval);
        while (memm.steps() < until) memm.step();
        lost = is_lost();
    }
    Outcome outcome = outcome_of(ledger, start.scale, steps);
    outcome.seconds = time.seconds();
    if (start.isolated) {
        const dynamics::IntegratorState state{.q = start.q, .p_before = start.p, .p_after = start.p};
        const MomentumScales scales = momentum_scales<Dim>(dynamics::RunView<Dim>(state), host.rest_positions());
        outcome.momentum = ledger.momentum_drift() / scales.linear;
        outcome.pseudo_angular = ledger.pseudo_angular_momentum_drift() / scales.angular;
    }
    if (lost) outcome.ending = fmt::format("explodes by step {}", memm.steps());
    return outcome;
}

}  // namespace abut::studies::long_runs
