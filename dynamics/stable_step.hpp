#pragma once
#include "abut/dynamics/solid.hpp"

namespace abut::dynamics {

struct StableStep {
    double omega_max;  ///< highest frequency without contact [rad/s]: the last Rayleigh quotient, a lower bound, times 1.02
    double dt;         ///< 2 / omega_max, times 0.85 with contact: a closed contact stiffens its cells [s]
    int iterations;
    double change;  ///< relative change of the last iteration
};

/// Power iteration on M^-1 K from a fixed start: at least 50 iterations and until the Rayleigh quotient changes by less than
/// 1e-4, at most 2,000. docs/method.md, Space. Throws std::runtime_error if it does not settle.
template <int Dim>
[[nodiscard]] StableStep stable_step(Solid<Dim>& solid);

/// The stable step of cells whose highest frequency is omega [rad/s], with the same margin for contact [s].
template <int Dim>
[[nodiscard]] double stable_step_of(const Solid<Dim>& solid, double omega);

}  // namespace abut::dynamics
