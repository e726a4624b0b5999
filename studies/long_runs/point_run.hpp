#pragma once
#include <fmt/format.h>
#include <algorithm>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/neutral_restart.hpp"
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

/// How far momentum and J~ drift from their start, over the sums of their sizes there.
template <int Dim>
class Drifts {
public:
    template <class Host>
    Drifts(const Host& host, std::span<const double> p_at_start) {
        const auto p = as_vectors<Dim>(p_at_start);
        for (std::size_t i = 0; i < p.size(); ++i) {
            momentum_scale_ += p[i].norm();
            spin_scale_ += moment<Dim>(host.rest_positions()[i], p[i]).norm();
        }
    }
    void record(const Vector<Dim>& momentum, const dynamics::AngularMomentum<Dim>& spin) {
        if (!begun_) momentum_at_start_ = momentum, spin_at_start_ = spin;
        begun_ = true;
        momentum_ = std::fmax(momentum_, (momentum - momentum_at_start_).norm());
        spin_ = std::fmax(spin_, (spin - spin_at_start_).norm());
    }
    [[nodiscard]] double momentum() const { return momentum_ / momentum_scale_; }
    [[nodiscard]] double spin() const { return spin_ / spin_scale_; }

private:
    double momentum_scale_ = 0.0, spin_scale_ = 0.0, momentum_ = 0.0, spin_ = 0.0;
    bool begun_ = false;
    Vector<Dim> momentum_at_start_;
    dynamics::AngularMomentum<Dim> spin_at_start_;
};

/// Runs a host under MEMM.
template <class Host>
Outcome run_points(Host& host, const PointStart& start, const Remedy& remedy, std::int64_t steps) {
    constexpr int Dim = Host::dimension;
    dynamics::Memm memm(host, start.q, start.p, start.dt);
    dynamics::NeutralFilter filter(host);
    dynamics::NeutralRestart restart(host, {.period = std::max(remedy.restart, 1)});
    if (remedy.filter)
        memm.set_after_step([&](auto q, double dt, auto before, auto after) { filter(q, dt, before, after); });
    if (remedy.restart > 0)
        memm.set_node_restart([&](auto q, double dt, auto before, auto after) { restart(q, dt, before, after); });

    const ProcessorTime time;
    Figures<Dim> figures(start.scale, steps);
    Drifts<Dim> drifts(host, start.p);
    double pseudo_energy = unknown;  // at the start
    const auto is_lost = [&] {
        const auto entry = dynamics::measure(memm, host, restart.report());
        figures.record(entry);
        drifts.record(entry.linear_momentum,
                      dynamics::pseudo_angular_momentum<Dim>(memm, start.dt, host.rest_positions(), host.masses()));
        if (std::isnan(pseudo_energy)) pseudo_energy = entry.pseudo_energy;
        return !(entry.energy - pseudo_energy <= explosion_factor * start.scale);
    };
    bool lost = is_lost();
    while (memm.steps() < steps && !lost) {
        const std::int64_t until = std::min<std::int64_t>(steps, memm.steps() + record_interval);
        while (memm.steps() < until) memm.step();
        lost = is_lost();
    }
    Outcome outcome = figures.outcome();
    outcome.seconds = time.seconds();
    if (start.isolated) outcome.momentum = drifts.momentum(), outcome.spin = drifts.spin();
    if (lost) outcome.end = fmt::format("explodes by step {}", memm.steps());
    return outcome;
}

}  // namespace abut::studies::long_runs
