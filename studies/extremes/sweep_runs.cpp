#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/extremes/families.hpp"
#include "studies/extremes/scenes.hpp"

namespace abut::studies::extremes {
namespace {

/// --steps of them, energies every hundredth.
run::RunOptions long_run(const SweepOptions& options) {
    run::RunOptions run = options.run;
    run.steps = options.quick ? std::min(options.steps, 2000) : options.steps;
    run.interval = 100;
    run.filter = true;
    return run;
}

/// The ledger must see how far the bar has turned, and that its spin about the positions at rest is conserved.
std::string ask_of_spin(const run::RunResult<2>& result, double rate, const Growth& growth, Row& row) {
    const double time = static_cast<double>(result.run.steps) * result.run.dt, angle = std::atan(rate * time);
    const double expected = std::hypot(1.0, rate * growth.time) - 1.0;  // 1/cos
    row.numbers.push_back({"growth", growth.of_cell});
    const double spin = result.ledger.entries().front().rest_angular_momentum.norm();
    const double drift = result.ledger.rest_angular_momentum_drift() / spin;
    if (!(std::abs(result.ledger.rotation() - angle) <= largest_deviation))
        return fmt::format("the ledger says {:.10g} rad, it has turned by {:.10g}", result.ledger.rotation(), angle);
    if (!(drift <= largest_momentum_drift))
        return fmt::format("angular momentum about the positions at rest drifts by {:.2g}", drift);
    if (!(std::abs(growth.of_cell - expected) <= largest_deviation))
        return fmt::format("it has grown by {:.10g}, 1/cos says {:.10g}", growth.of_cell, expected);
    return "";
}

/// Momentum along the rollers, the last axis, is conserved; across them they hold the blocks.
template <int Dim>
std::string ask_of_rollers(const run::RunResult<Dim>& result, Row& row) {
    const auto along = [](const dynamics::LedgerEntry<Dim>& entry) { return entry.linear_momentum[Dim - 1]; };
    double scale = 0.0, drift = 0.0;
    for (const auto& body : result.bodies.start) scale += body.mass * body.velocity.norm();
    for (const auto& entry : result.ledger.entries())
        drift = std::max(drift, std::abs(along(entry) - along(result.ledger.entries().front())));
    row.momentum = drift / scale;
    if (row.momentum <= largest_momentum_drift) return "";
    return fmt::format("momentum along the rollers drifts by {:.2g}, {:g} is allowed", row.momentum, largest_momentum_drift);
}

template <int Dim>
Row roll(const Meeting<Dim>& meeting, bool filter, run::RunOptions run) {
    run.filter = filter;
    return attempt<Dim>({.family = "rollers",
                         .value = fmt::format("{}D, {} the filter", Dim, filter ? "with" : "without"),
                         .speed = meeting.speed,
                         .keeps_momentum = false,
                         .make = [meeting] { return blocks_on_rollers<Dim>(meeting); },
                         .run = run,
                         .ask_more = ask_of_rollers<Dim>});
}

}  // namespace

void sweep_spin(const SweepOptions& options, const Sink& sink) {
    constexpr double rate = 0.05;
    for (const double angle : {0.01, 0.1, 0.14, 0.46, 1.0}) {
        if (options.quick && angle > 0.1) continue;
        Growth growth;
        Row row =
            attempt<2>({.family = "spin",
                        .value = fmt::format("{:g} rad", angle),
                        .speed = rate,
                        .keeps_momentum = false,
                        .meets = false,
                        .make = [&] { return spinning_bar(rate, angle, growth); },
                        .run = options.run,
                        .ask_more = [&](const auto& result, Row& of) { return ask_of_spin(result, rate, growth, of); }});
        if (row.message.empty()) row.message = fmt::format("it has grown by {:.2g} %", 100.0 * growth.of_cell);
        sink(row);
    }
}

void sweep_rollers(const SweepOptions& options, const Sink& sink) {
    for (const bool filter : {false, true}) {
        sink(roll<2>({.aside = 0.2}, filter, options.run));
        sink(roll<3>({.aside = 0.2}, filter, options.run));
    }
}

void sweep_crowd(const SweepOptions& options, const Sink& sink) {
    for (const int n : options.quick ? std::vector{3} : std::vector{3, 6})
        for (const double speed : {0.02, 0.1})
            sink(attempt<2>({.family = "crowd",
                             .value = fmt::format("{0} x {0} discs, {1:g} c", n, speed),
                             .speed = speed,
                             .make = [=] { return crowd(n, speed, 0.05); },
                             .run = options.run}));
}

void sweep_long(const SweepOptions& options, const Sink& sink) {
    for (const double cfl : {0.5, 0.9}) {
        run::RunOptions run = long_run(options);
        run.cfl = cfl;
        sink(attempt<2>({.family = "long",
                         .value = fmt::format("disc between walls, CFL {:g}", cfl),
                         .speed = 0.05,
                         .keeps_momentum = false,
                         .make = [] { return between_walls(0.05); },
                         .run = run}));
        run.contact.compression_limit = 10.0;  // the foot of the strip gives way by more than its cell
        sink(attempt<2>({.family = "long",
                         .value = fmt::format("falling strip, CFL {:g}", cfl),
                         .speed = 0.1,
                         .keeps_momentum = false,
                         .make = [] { return falling_strip(20); },
                         .run = run}));
    }
}

void sweep_rest(const SweepOptions& options, const Sink& sink) {
    for (const double load : {1e-6, 1e-3, 1e-2, 1e-1})
        sink(attempt<2>({.family = "rest",
                         .value = fmt::format("weight = {:g} E A", load),
                         .speed = load,
                         .keeps_momentum = false,
                         .make = [=] { return resting(load); },
                         .run = long_run(options)}));
}

}  // namespace abut::studies::extremes
