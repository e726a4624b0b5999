#include <fmt/format.h>

#include <algorithm>

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

}  // namespace

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
