#pragma once
// Private to the sources of this layer.
#include <cmath>
#include <limits>
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

/// What omega is taken for [rad/s].
[[nodiscard]] inline double bound_of(const HighestMode& mode) { return lower_bound_margin * std::sqrt(mode.quotient); }

struct PowerIterationOptions {
    int least = 50;                                           ///< iterations before it may count as settled
    int least_beyond = 10;                                    ///< iterations before `enough` ends it
    double enough = std::numeric_limits<double>::infinity();  ///< quotient beyond which it need not settle [1/s^2]
    std::span<const double> mask = {};                        ///< 1 for a degree of freedom that may move, 0; empty: all may
};

/// Iterations from a fixed start until the quotient has settled or is beyond `enough`, at most 2,000.
template <int Dim>
[[nodiscard]] HighestMode highest_mode(Solid<Dim>& solid, const PowerIterationOptions& options = {});

}  // namespace abut::dynamics
