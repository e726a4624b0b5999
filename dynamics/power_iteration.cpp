#include "abut/dynamics/power_iteration.hpp"

#include <random>
#include <utility>

#include "abut/dynamics/mass.hpp"

namespace abut::dynamics {
namespace {

inline constexpr int most_iterations = 2000;

}  // namespace

HighestMode highest_mode(std::span<const double> inverse_mass,
                         const std::function<void(std::span<const double> x, std::span<double> product)>& stiffness,
                         const PowerIterationOptions& options) {
    const auto& [least, least_beyond, enough, mask] = options;
    const std::size_t n = inverse_mass.size();
    std::vector<double> x(n), k_x(n), m_x(n);
    std::minstd_rand random(1);
    for (double& value : x) value = static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5;
    for (std::size_t i = 0; i < mask.size(); ++i) x[i] *= mask[i];

    double quotient = 0.0;
    double change = std::numeric_limits<double>::infinity();
    int iteration = 0;
    const auto is_done = [&] {
        if (quotient > enough) return iteration >= least_beyond;
        return iteration >= least && (change <= settled_change || iteration >= most_iterations);
    };
    while (!is_done()) {
        stiffness(x, k_x);
        for (std::size_t i = 0; i < n; ++i) m_x[i] = x[i] / inverse_mass[i];
        const double next = dot_product(x, k_x) / dot_product(x, m_x);
        if (next == 0.0 && dot_product(k_x, k_x) == 0.0) return {0.0, 0.0, iteration, std::move(x)};  // nothing resists
        change = std::abs(next - quotient) / next;
        quotient = next;
        for (std::size_t i = 0; i < n; ++i) x[i] = inverse_mass[i] * k_x[i];
        for (std::size_t i = 0; i < mask.size(); ++i) x[i] *= mask[i];
        const double size = std::sqrt(dot_product(x, x));
        for (double& value : x) value /= size;
        ++iteration;
    }
    return {quotient, change, iteration, std::move(x)};
}

}  // namespace abut::dynamics
