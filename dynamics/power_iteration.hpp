#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "abut/dynamics/ranks.hpp"

namespace abut::dynamics {

/// A system with a diagonal mass that knows the linear part K q of its restoring force.
template <class S>
concept StiffnessProductSystem = requires(S& system, std::span<const double> q, std::span<double> product) {
    { system.size() } -> std::convertible_to<std::size_t>;
    { system.inverse_mass() } -> std::convertible_to<std::span<const double>>;  ///< [1/kg]
    system.stiffness_product(q, product);                                       ///< K q [N]
};

/// The highest mode of M^-1 K: x is the last iterate, of length 1.
struct HighestMode {
    double quotient;  ///< Rayleigh quotient omega^2 [1/s^2], a lower bound of the true one
    double change;    ///< relative change of the last iteration
    int iterations;
    std::vector<double> x;
};

inline constexpr double settled_change = 1e-4;      ///< of the quotient: then the iteration ends
inline constexpr double lower_bound_margin = 1.02;  ///< of omega: a Rayleigh quotient never exceeds the largest eigenvalue

/// The frequency that steps are chosen for: the estimate times its margin [rad/s].
[[nodiscard]] inline double bound_of(const HighestMode& mode) { return lower_bound_margin * std::sqrt(mode.quotient); }

struct PowerIterationOptions {
    int least = 50;                                           ///< iterations before it may count as settled
    int least_beyond = 10;                                    ///< iterations before `enough` ends it
    double enough = std::numeric_limits<double>::infinity();  ///< quotient beyond which it need not settle [1/s^2]
    std::span<const double> mask = {};                        ///< 1 for a degree of freedom that may move, 0; empty: all may
    const Ranks* ranks = nullptr;                             ///< whose values these are a part of; null: all are here
};

/// Iterations from a fixed start until the quotient has settled or is beyond `enough`, at most 2,000. `stiffness` sets
/// product = K x; M is diagonal, 1/m in `inverse_mass` (n) [1/kg].
[[nodiscard]] HighestMode highest_mode(
    std::span<const double> inverse_mass,
    const std::function<void(std::span<const double> x, std::span<double> product)>& stiffness,
    const PowerIterationOptions& options = {});

/// The same of a system.
template <StiffnessProductSystem S>
[[nodiscard]] HighestMode highest_mode(S& system, PowerIterationOptions options = {}) {
    options.ranks = ranks_of(system);
    return highest_mode(
        system.inverse_mass(),
        [&](std::span<const double> x, std::span<double> product) { system.stiffness_product(x, product); }, options);
}

}  // namespace abut::dynamics
