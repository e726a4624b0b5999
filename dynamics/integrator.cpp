#include "abut/dynamics/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics::detail {
namespace {

void require_finite(std::span<const double> values, const std::string& name, const std::string& unit) {
    const auto wrong = std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (wrong != values.end())
        throw BadInput("integrator: " + name + " " + std::to_string(wrong - values.begin()) + " is " + number(*wrong) + " " +
                           unit + " at the start; it must be finite.",
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

void refuse_constraints() {
    throw BadInput(
        "integrator: rigid bodies are held together by constraints, which this scheme does not know. Take Memm or "
        "Leapfrog, or bodies that deform.");
}

}  // namespace abut::dynamics::detail
