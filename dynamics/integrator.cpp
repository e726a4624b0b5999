#include "abut/dynamics/integrator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics::detail {
namespace {

void require_finite(std::span<const double> values, const std::string& name, const std::string& unit,
                    const std::string& where = "at the start") {
    const auto wrong = std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (wrong != values.end())
        throw BadInput("integrator: " + name + " " + std::to_string(wrong - values.begin()) + " is " + number(*wrong) + " " +
                           unit + " " + where + "; it must be finite.",
                       {.value = *wrong});
}

}  // namespace

void check_step(double dt) {
    if (!(dt > 0.0) || !std::isfinite(dt))
        throw BadInput(
            "time step is " + number(dt) + " s; it must be finite and > 0. `stable_step` says how large it may be.",
            {.value = dt});
}

void check_start(std::size_t size, std::span<const double> q, std::span<const double> p) {
    if (q.size() != size || p.size() != size)
        throw BadInput(
            "integrator: the state has " + std::to_string(q.size()) + " positions and " + std::to_string(p.size()) +
                " momenta, the system " + std::to_string(size) + " degrees of freedom.",
            {.value = static_cast<double>(q.size() != size ? q.size() : p.size()), .allowed = static_cast<double>(size)});
    require_finite(q, "position", "m");
    require_finite(p, "momentum", "kg m/s");
}

void check_state(const IntegratorState& state, std::size_t size, std::size_t of_scheme) {
    for (const std::size_t found : {state.q.size(), state.p_before.size(), state.p_after.size()})
        if (found != size)
            throw BadInput("integrator: a saved state has " + std::to_string(found) +
                               " values of positions or momenta, the system " + std::to_string(size) +
                               " degrees of freedom. Restore it where it was saved.",
                           {.value = static_cast<double>(found), .allowed = static_cast<double>(size)});
    if (state.of_scheme.size() != of_scheme)
        throw BadInput("integrator: a saved state has " + std::to_string(state.of_scheme.size()) +
                       " values of its scheme, " + std::to_string(of_scheme) +
                       " are needed. Restore it under the scheme that saved it.");
    check_step(state.dt);
    const std::string saved = "in a saved state";
    require_finite(state.q, "position", "m", saved);
    require_finite(state.p_before, "momentum", "kg m/s", saved);
    require_finite(state.p_after, "momentum", "kg m/s", saved);
    require_finite(state.of_scheme, "value of the scheme", "", saved);
    require_finite(std::array{state.time, state.restart_jumps}, "time or energy", "", saved);
    if (state.steps < 0)
        throw BadInput("integrator: a saved state has taken " + std::to_string(state.steps) +
                       " steps; 0 or more are possible.");
}

void refuse_constraints() {
    throw BadInput(
        "integrator: rigid bodies are held together by constraints, which this scheme does not know. Take Memm or "
        "Leapfrog, or bodies that deform.");
}

}  // namespace abut::dynamics::detail
