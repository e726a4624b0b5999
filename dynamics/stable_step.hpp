#pragma once
#include <cmath>
#include <limits>

#include "abut/dynamics/highest_mode.hpp"

namespace abut::dynamics {

struct StableStep {
    double omega_max;  ///< highest frequency without contact [rad/s]: that of the largest Rayleigh quotient, times 1.02
    double dt;         ///< 2 / omega_max times the margin of the system, less where it is damped [s]
    int iterations;
    double change;  ///< relative change of the last iteration
};

/// The part of 2/omega_max that a system allows for a step [-]: its own `step_margin`, 1 if it has none. A closed contact
/// stiffens its cells, and K knows nothing of it.
template <StiffnessProductSystem S>
[[nodiscard]] double step_margin(const S& system) {
    if constexpr (requires { system.step_margin(); })
        return system.step_margin();
    else
        return 1.0;
}

/// The part of 2/omega that a mode of this frequency [rad/s] allows for a step where forces act on the mean of two
/// rates [-]: with z = `damping_ratio(omega)` of the system, its damping over what is critical, sqrt(1 + z^2) - z; 1 if
/// it has none.
template <StiffnessProductSystem S>
[[nodiscard]] double damped_part(const S& system, double omega) {
    if constexpr (requires { system.damping_ratio(omega); }) {
        const double ratio = system.damping_ratio(omega);
        return ratio > 0.0 ? std::sqrt(1.0 + ratio * ratio) - ratio : 1.0;
    } else {
        return 1.0;
    }
}

/// The stable step of degrees of freedom whose highest frequency is omega [rad/s], with the margin and the damping of their
/// system [s].
template <StiffnessProductSystem S>
[[nodiscard]] double stable_step_of(const S& system, double omega) {
    return step_margin(system) * damped_part(system, omega) * 2.0 / omega;
}

namespace detail {
/// Throws BadInput if the iteration has not settled.
void require_settled(const HighestMode& mode);
}  // namespace detail

/// From the highest mode of M^-1 K. Throws BadInput if the search for it does not settle. Infinite where nothing resists or
/// is free, as of free rigid bodies.
template <StiffnessProductSystem S>
[[nodiscard]] StableStep stable_step(S& system) {
    const HighestMode mode = highest_mode(system);
    if (mode.quotient == 0.0) return {0.0, std::numeric_limits<double>::infinity(), mode.iterations, 0.0};
    detail::require_settled(mode);
    const double omega = bound_of(mode);
    return {omega, stable_step_of(system, omega), mode.iterations, mode.change};
}

}  // namespace abut::dynamics
