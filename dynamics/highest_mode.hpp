#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <functional>
#include <span>

#include "abut/dynamics/ranks.hpp"

namespace abut::dynamics {

/// A system with a diagonal mass that knows the linear part K q of its restoring force.
template <class S>
concept StiffnessProductSystem = requires(S& system, std::span<const double> q, std::span<double> product) {
    { system.size() } -> std::convertible_to<std::size_t>;
    { system.inverse_mass() } -> std::convertible_to<std::span<const double>>;  ///< [1/kg]
    system.stiffness_product(q, product);                                       ///< K q [N]
};

/// The highest mode of M^-1 K.
struct HighestMode {
    double quotient;  ///< omega^2 [1/s^2], at most the largest eigenvalue; 0 where nothing resists or nothing is free
    double change;    ///< of it, relative, in the last iteration; 0 where the products span nothing new
    int iterations;
};

inline constexpr double settled_change = 5e-4;      ///< of the quotient: then the search ends
inline constexpr double lower_bound_margin = 1.02;  ///< of omega: a Rayleigh quotient never exceeds the largest eigenvalue

/// The frequency that steps are chosen for: the estimate times its margin [rad/s].
[[nodiscard]] inline double bound_of(const HighestMode& mode) { return lower_bound_margin * std::sqrt(mode.quotient); }

/// The iteration of Lanczos from a fixed start, without reorthogonalization: at least 16 products and until the quotient has
/// settled, fewer where they span nothing new before, at most 1,000. `stiffness` sets product = K x; M is diagonal, 1/m in
/// `inverse_mass` (n) [1/kg], 0 for a degree of freedom that is held. `ranks`: whose values these are a part of.
/// C. Lanczos, J. Res. Natl. Bur. Stand. 45 (1950) 255-282; docs/method.md, Space, says how near it comes.
[[nodiscard]] HighestMode highest_mode(
    std::span<const double> inverse_mass,
    const std::function<void(std::span<const double> x, std::span<double> product)>& stiffness,
    const Ranks& ranks = one_rank());

/// Highest mode of a system.
template <StiffnessProductSystem S>
[[nodiscard]] HighestMode highest_mode(S& system) {
    return highest_mode(
        system.inverse_mass(),
        [&](std::span<const double> x, std::span<double> product) { system.stiffness_product(x, product); },
        ranks_of(system));
}

}  // namespace abut::dynamics
