#include "studies/schemes/schemes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "abut/base/error.hpp"
#include "apps/support/command_line.hpp"

namespace abut::studies {
namespace {

using dynamics::PathMean;

const apps::Choices<PathMean> means = {
    {"system", PathMean::system}, {"1", PathMean::gauss_1}, {"2", PathMean::gauss_2}, {"3", PathMean::gauss_3}};
const apps::Choices<bool> starts = {{"half", false}, {"naive", true}};

std::vector<std::string> names_of(const std::vector<Scheme>& schemes) {
    std::vector<std::string> names;
    for (const Scheme scheme : schemes) names.push_back(name_of(scheme));
    return names;
}

bool known_to_any(const std::vector<Scheme>& known, const std::vector<Scheme>& chosen) {
    return std::ranges::any_of(chosen, [&](Scheme scheme) { return std::ranges::find(known, scheme) != known.end(); });
}

}  // namespace

void add_integrator(apps::CommandParser& parser, SchemeOptions& options) {
    apps::Choices<std::vector<Scheme>> choices = {{"all", options.schemes}};
    for (const Scheme scheme : options.schemes) choices.push_back({name_of(scheme), {scheme}});
    apps::add_choice(parser, "--integrator", options.schemes, "scheme in time (docs/integrators.md)", choices)
        .group("Schemes");
}

void add_mean(apps::CommandParser& parser, SchemeOptions& options) {
    apps::Flag mean =
        apps::add_choice(parser, "--mean", options.mean,
                         "of memm and energy_momentum: mean of the force along a step, exact or by Gauss points", means);
    restrict_to(mean.group("Schemes"), options, {Scheme::memm, Scheme::energy_momentum});
}

void add_gauge(apps::CommandParser& parser, SchemeOptions& options) {
    apps::Flag gauge = apps::add_number(parser, "--gauge", options.gauge, "of bilbao: c in psi = sqrt(2 (V + c))",
                                        {.unit = "J", .above = 0.0, .zero = true});
    restrict_to(gauge.group("Schemes"), options, {Scheme::bilbao});
}

void add_local_steps(apps::CommandParser& parser, SchemeOptions& options) {
    apps::Flag parts =
        apps::add_count(parser, "--parts", options.parts, "of memm_async: steps of the fast masses in one of the others", 1);
    apps::Flag fast =
        apps::add_count(parser, "--fast", options.fast, "of memm_async: how many masses, from the first on, are fast", 0);
    for (apps::Flag option : {parts, fast}) restrict_to(option.group("Schemes"), options, {Scheme::memm_async});
}

void add_start(apps::CommandParser& parser, SchemeOptions& options) {
    apps::Flag start = apps::add_choice(parser, "--start", options.naive_start,
                                        "momenta half a step before and after: p -+ dt/2 F, or naively p for both", starts);
    restrict_to(start.group("Schemes"), options, {Scheme::memm, Scheme::leapfrog, Scheme::bilbao, Scheme::memm_async});
}

void restrict_to(const apps::Flag& option, SchemeOptions& options, std::vector<Scheme> schemes) {
    options.special.emplace_back(option, std::move(schemes));
}

void check(const SchemeOptions& options) {
    for (const auto& [option, schemes] : options.special) {
        if (!option.is_given() || known_to_any(schemes, options.schemes)) continue;
        throw BadInput(fmt::format("{}: {} does not know it. Take --integrator {}, or leave {} out.", option.name(),
                                   fmt::join(names_of(options.schemes), ", "), fmt::join(names_of(schemes), " or "),
                                   option.name()));
    }
}

run::NamedValues named_values(const SchemeOptions& options) {
    const run::NamedValues values = {{"mean", apps::name_of(means, options.mean)},
                                     {"gauge", options.gauge},
                                     {"fast", options.fast},
                                     {"parts", options.parts},
                                     {"start", apps::name_of(starts, options.naive_start)}};
    run::NamedValues used = {{"integrator", names_of(options.schemes)}};
    for (const auto& [option, schemes] : options.special)
        for (const run::NamedValue& value : values)
            if (option.name() == "--" + value.name && known_to_any(schemes, options.schemes)) used.push_back(value);
    return used;
}

dynamics::LocalSteps local_steps_of_first(const SchemeOptions& options, std::size_t n) {
    const auto fast = static_cast<std::size_t>(options.fast);
    if (fast > n) throw BadInput(fmt::format("--fast: {} masses, there are {}. Give at most that many.", fast, n));
    dynamics::LocalSteps steps{.parts = {1}, .level = std::vector<std::int32_t>(n, 0)};
    if (options.parts == 1) return steps;
    steps.parts.push_back(options.parts);
    std::fill_n(steps.level.begin(), fast, 1);
    return steps;
}

}  // namespace abut::studies
