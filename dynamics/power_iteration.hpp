#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/dynamics/solid.hpp"

namespace abut::dynamics {

/// The highest mode of M^-1 K: x is the last iterate, of length 1.
struct HighestMode {
    double quotient;  ///< Rayleigh quotient omega^2 [1/s^2], a lower bound of the true one
    double change;    ///< relative change of the last iteration
    int iterations;
    std::vector<double> x;
};

inline constexpr double settled_change = 1e-4;      ///< of the quotient: then the iteration ends
inline constexpr double lower_bound_margin = 1.02;  ///< of omega: a Rayleigh quotient never exceeds the largest eigenvalue

/// Iterations from a fixed start, `least` at least, until the quotient has settled, at most 2,000. With a
/// `mask` (1 or 0 a degree of freedom) of the part of the body that is free to move; empty: all.
template <int Dim>
[[nodiscard]] HighestMode highest_mode(Solid<Dim>& solid, std::span<const double> mask = {}, int least = 50);

}  // namespace abut::dynamics
