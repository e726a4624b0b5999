#include "abut/dynamics/power_iteration.hpp"

#include <random>
#include <utility>

#include "abut/dynamics/mass.hpp"

namespace abut::dynamics {
namespace {

inline constexpr int most_iterations = 2000;

/// The same numbers for any number of ranks: each takes those of its points.
void start(std::span<double> x, const Ranks* ranks) {
    std::minstd_rand random(1);
    const auto next = [&] { return static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5; };
    if (!ranks) {
        for (double& value : x) value = next();
        return;
    }
    const auto dimension = static_cast<std::size_t>(ranks->dimension());
    std::int32_t point = 0;
    for (std::size_t i = 0; i < x.size(); i += dimension) {
        const std::int32_t number = ranks->numbers()[i / dimension];
        random.discard(dimension * static_cast<std::size_t>(number - point));
        for (std::size_t j = 0; j < dimension; ++j) x[i + j] = next();
        point = number + 1;
    }
}

}  // namespace

HighestMode highest_mode(std::span<const double> inverse_mass,
                         const std::function<void(std::span<const double> x, std::span<double> product)>& stiffness,
                         const PowerIterationOptions& options) {
    const auto& [least, least_beyond, enough, mask, ranks] = options;
    const std::size_t n = inverse_mass.size();
    std::vector<double> x(n), k_x(n), m_x(n);
    start(x, ranks);
    for (std::size_t i = 0; i < mask.size(); ++i) x[i] *= mask[i];

    double quotient = 0.0;
    double change = std::numeric_limits<double>::infinity();
    int iteration = 0;
    const auto product = [ranks = ranks](const std::vector<double>& a, const std::vector<double>& b) {
        return ranks ? dot_product_over(*ranks, a, b) : dot_product(a, b);
    };
    const auto is_done = [&] {
        if (quotient > enough) return iteration >= least_beyond;
        return iteration >= least && (change <= settled_change || iteration >= most_iterations);
    };
    while (!is_done()) {
        stiffness(x, k_x);
        for (std::size_t i = 0; i < n; ++i) m_x[i] = x[i] / inverse_mass[i];
        const double next = product(x, k_x) / product(x, m_x);
        if (next == 0.0 && product(k_x, k_x) == 0.0) return {0.0, 0.0, iteration, std::move(x)};  // nothing resists
        change = std::abs(next - quotient) / next;
        quotient = next;
        for (std::size_t i = 0; i < n; ++i) x[i] = inverse_mass[i] * k_x[i];
        for (std::size_t i = 0; i < mask.size(); ++i) x[i] *= mask[i];
        const double size = std::sqrt(product(x, x));
        for (double& value : x) value /= size;
        ++iteration;
    }
    return {quotient, change, iteration, std::move(x)};
}

}  // namespace abut::dynamics
