// Closed forms of one-dimensional gas dynamics. E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 4.
#pragma once
#include <cmath>

#include "cut_cell_gas.hpp"

namespace gas {

/// By how much one side changes its velocity on the way to pressure p, through a shock or a fan.
inline double change_of_velocity(const State& side, double p) {
    if (p > side.p) return (p - side.p) * std::sqrt(2.0 / (side.rho * ((ratio + 1.0) * p + (ratio - 1.0) * side.p)));
    return 2.0 * side.sound() / (ratio - 1.0) * (std::pow(p / side.p, 0.5 * (ratio - 1.0) / ratio) - 1.0);
}

/// Between two states at rest or in motion along x: pressure and velocity of the middle, by bisection.
struct Middle {
    double p, u;
};
inline Middle middle_of(const State& left, const State& right) {
    double low = 0.0, high = 1e3 * (left.p + right.p);
    for (int k = 0; k < 200; ++k) {
        const double p = 0.5 * (low + high);
        const double excess = change_of_velocity(left, p) + change_of_velocity(right, p) + right.u - left.u;
        (excess < 0.0 ? low : high) = p;
    }
    return {low, left.u - change_of_velocity(left, low)};
}

/// Behind the wave that runs to the right into `ahead`, as seen at x/t = s.
inline State right_wave(const State& ahead, const Middle& middle, double s) {
    const double a = ahead.sound(), g = (ratio - 1.0) / (ratio + 1.0), rise = middle.p / ahead.p;
    if (rise > 1.0) {
        const double speed = ahead.u + a * std::sqrt(0.5 * (ratio + 1.0) / ratio * rise + 0.5 * (ratio - 1.0) / ratio);
        if (s > speed) return ahead;
        return {ahead.rho * (rise + g) / (g * rise + 1.0), middle.u, ahead.v, middle.p};
    }
    const double a_middle = a * std::pow(rise, 0.5 * (ratio - 1.0) / ratio);
    if (s > ahead.u + a) return ahead;
    if (s < middle.u + a_middle) return {ahead.rho * std::pow(rise, 1.0 / ratio), middle.u, ahead.v, middle.p};
    const double u = 2.0 / (ratio + 1.0) * (-a + 0.5 * (ratio - 1.0) * ahead.u + s), here = (s - u) / a;  // sound over a
    return {ahead.rho * std::pow(here, 2.0 / (ratio - 1.0)), u, ahead.v,
            ahead.p * std::pow(here, 2.0 * ratio / (ratio - 1.0))};
}

/// The solution of the Riemann problem at x/t = s.
inline State riemann(const State& left, const State& right, double s) {
    const Middle middle = middle_of(left, right);
    if (s > middle.u) return right_wave(right, middle, s);
    const State mirrored{left.rho, -left.u, left.v, left.p};
    State result = right_wave(mirrored, {middle.p, -middle.u}, -s);
    result.u = -result.u;
    return result;
}

/// On a rigid wall that reflects a shock which runs into gas at rest with p_0, and leaves p behind it.
inline double reflected(double p, double p_0) {
    return p * ((3.0 * ratio - 1.0) * p - (ratio - 1.0) * p_0) / ((ratio - 1.0) * p + (ratio + 1.0) * p_0);
}

}  // namespace gas
