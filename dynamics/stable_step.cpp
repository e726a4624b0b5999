#include "abut/dynamics/stable_step.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include "abut/dynamics/parallel.hpp"
#include "abut/geometry/messages.hpp"

namespace abut::dynamics {
namespace {

inline constexpr int least_iterations = 50;
inline constexpr int most_iterations = 2000;
inline constexpr double settled_change = 1e-4;
inline constexpr double lower_bound_margin = 1.02;  // a Rayleigh quotient never exceeds the largest eigenvalue
inline constexpr double contact_margin = 0.85;

double product(std::span<const double> a, std::span<const double> b) {
    return ordered_sum(static_cast<std::ptrdiff_t>(a.size()), 0.0, [&](std::ptrdiff_t i) { return a[i] * b[i]; });
}

}  // namespace

template <int Dim>
StableStep stable_step(Solid<Dim>& solid) {
    const std::span<const double> inverse_mass = solid.inverse_mass();
    const std::size_t n = solid.size();
    std::vector<double> x(n), k_x(n), m_x(n);
    std::minstd_rand random(1);
    for (double& value : x) value = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;

    double quotient = 0.0;
    double change = std::numeric_limits<double>::infinity();
    int iteration = 0;
    while (iteration < least_iterations || (change > settled_change && iteration < most_iterations)) {
        solid.stiffness_product(x, k_x);
        for (std::size_t i = 0; i < n; ++i) m_x[i] = x[i] / inverse_mass[i];
        const double next = product(x, k_x) / product(x, m_x);
        change = std::abs(next - quotient) / next;
        quotient = next;
        for (std::size_t i = 0; i < n; ++i) x[i] = inverse_mass[i] * k_x[i];
        const double size = std::sqrt(product(x, x));
        for (double& value : x) value /= size;
        ++iteration;
    }
    if (!(change <= settled_change) || !(quotient > 0.0))
        throw std::runtime_error("stable step: the power iteration has not settled after " + std::to_string(iteration) +
                                 " iterations (relative change " + number(change) + ", allowed " + number(settled_change) +
                                 "). Check the mesh for slivers and the material for extreme values.");
    const double omega = lower_bound_margin * std::sqrt(quotient);
    return {omega, (solid.contact() ? contact_margin : 1.0) * 2.0 / omega, iteration, change};
}

template StableStep stable_step<2>(Solid<2>&);
template StableStep stable_step<3>(Solid<3>&);

}  // namespace abut::dynamics
