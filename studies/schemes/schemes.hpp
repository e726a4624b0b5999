#pragma once
#include <string>
#include <utility>
#include <vector>

#include "abut/dynamics/with_scheme.hpp"
#include "abut/run/values/value.hpp"
#include "apps/support/command_parser.hpp"

namespace abut::studies {

/// The schemes that small systems run under. docs/integrators.md says which to choose.
using Scheme = dynamics::Scheme;

inline const std::vector<Scheme> all_schemes = {Scheme::memm, Scheme::leapfrog, Scheme::bilbao, Scheme::energy_momentum,
                                                Scheme::memm_async};

/// Options about schemes in a program that compares them on a small system.
struct SchemeOptions {
    std::vector<Scheme> schemes = all_schemes;
    dynamics::PathMean mean = dynamics::PathMean::system;  ///< of memm and energy_momentum
    double gauge = 10.0;                                   ///< c of bilbao [J]
    int fast = 2;                                          ///< of memm_async: so many masses, from the first on, take ...
    int parts = 2;                                         ///< ... so many steps in one of the others
    bool naive_start = false;                              ///< p^{-1/2} = p^{1/2} = p^0 instead of p^0 -+ dt/2 F(q^0)

    /// Options that only some schemes know.
    std::vector<std::pair<apps::Flag, std::vector<Scheme>>> special;
};

/// Options by themselves; their defaults are the present values. `add_integrator` offers the present schemes, one or all.
void add_integrator(apps::CommandParser& parser, SchemeOptions& options);
void add_mean(apps::CommandParser& parser, SchemeOptions& options);
void add_gauge(apps::CommandParser& parser, SchemeOptions& options);
void add_local_steps(apps::CommandParser& parser, SchemeOptions& options);
void add_start(apps::CommandParser& parser, SchemeOptions& options);

/// Says that an option is for some schemes only.
void restrict_to(const apps::Flag& option, SchemeOptions& options, std::vector<Scheme> schemes);
/// Throws BadInput if an option was given that none of the chosen schemes knows.
void check(const SchemeOptions& options);

/// Values that were used of the options that were offered, by the names of the command line.
[[nodiscard]] run::NamedValues named_values(const SchemeOptions& options);

/// The first `options.fast` of n masses take `options.parts` steps. Throws BadInput if there are not so many.
[[nodiscard]] dynamics::LocalSteps local_steps_of_first(const SchemeOptions& options, std::size_t n);

/// Data from which an integrator is made.
struct Start {
    std::vector<double> q;
    std::vector<double> p;             ///< at the same time as q
    double dt;                         ///< [s]
    dynamics::LocalSteps local_steps;  ///< of memm_async
};

/// Calls body(integrator). The first step must be step(dt, StepChange::keep): an integrator that starts naively was
/// made for a step of nearly nothing, so that both of its half-step momenta are p^0.
template <class S, class Body>
void with_integrator(Scheme scheme, S& system, const Start& start, const SchemeOptions& options, const Body& body) {
    const double dt = options.naive_start ? 1e-100 * start.dt : start.dt;
    dynamics::with_scheme<S>(scheme, {.mean = options.mean, .gauge = options.gauge}, [&](const auto& make) {
        auto integrator = make(system, start.q, start.p, dt, start.local_steps);
        body(integrator);
    });
}

}  // namespace abut::studies
