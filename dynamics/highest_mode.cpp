#include "abut/dynamics/highest_mode.hpp"

#include <limits>
#include <random>
#include <vector>

#include "abut/base/decompositions.hpp"
#include "abut/base/parallel.hpp"
#include "abut/dynamics/mass.hpp"

namespace abut::dynamics {
namespace {

inline constexpr int least_iterations = 16, most_iterations = 1000;
// Side over quotient: below this the products span all that the start has a part of, and the rest is rounding.
inline constexpr double exhausted = 1e-12;

/// The same numbers for any number of ranks: each takes those of its points.
void start(std::span<double> x, const Ranks& ranks) {
    std::minstd_rand random(1);
    const auto next = [&] { return static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max()) - 0.5; };
    const auto dimension = static_cast<std::size_t>(ranks.dimension());
    std::int32_t point = 0;
    for (std::size_t i = 0; i < x.size(); i += dimension) {
        const std::int32_t number = ranks.number_of(i / dimension);
        random.discard(dimension * static_cast<std::size_t>(number - point));
        for (std::size_t j = 0; j < dimension; ++j) x[i + j] = next();
        point = number + 1;
    }
}

}  // namespace

/// In y = M^1/2 x, of which A = M^-1/2 K M^-1/2 is symmetric: A v_k = side_{k-1} v_{k-1} + diagonal_k v_k + side_k v_{k+1}.
/// M is in units of its least mass, so that another unit of mass, a power of two of this one, changes no bit of a root.
HighestMode highest_mode(std::span<const double> inverse_mass,
                         const std::function<void(std::span<const double> x, std::span<double> product)>& stiffness,
                         const Ranks& ranks) {
    const auto product = [&](std::span<const double> a, std::span<const double> b) { return dot_product_over(ranks, a, b); };
    const auto each = [n = static_cast<std::ptrdiff_t>(inverse_mass.size())](const auto& body) { parallel_each(n, body); };
    // `other` holds v_{k-1}, then side_k v_{k+1}.
    std::vector<double> root(inverse_mass.size()), v(root.size()), other(root.size(), 0.0), x(root.size()), k_x(root.size());
    const double unit = ranks.largest(largest(std::ssize(inverse_mass), [&](std::ptrdiff_t i) { return inverse_mass[i]; }));
    if (unit == 0.0) return {.quotient = 0.0, .change = 0.0, .iterations = 0};  // nothing is free
    each([&](std::ptrdiff_t i) { root[i] = std::sqrt(inverse_mass[i] / unit); });
    start(v, ranks);
    each([&](std::ptrdiff_t i) { v[i] = root[i] > 0.0 ? v[i] : 0.0; });
    const double length = std::sqrt(product(v, v));
    each([&](std::ptrdiff_t i) { v[i] /= length; });

    double side = 0.0;
    std::vector<double> diagonal, sides;
    HighestMode mode{.quotient = 0.0, .change = std::numeric_limits<double>::infinity(), .iterations = 0};
    while (mode.iterations < most_iterations) {
        each([&](std::ptrdiff_t i) { x[i] = root[i] * v[i]; });
        stiffness(x, k_x);
        each([&](std::ptrdiff_t i) { other[i] = root[i] * k_x[i] - side * other[i]; });
        diagonal.push_back(product(other, v));
        each([&](std::ptrdiff_t i) { other[i] -= diagonal.back() * v[i]; });
        side = std::sqrt(product(other, other));

        const double quotient = largest_eigenvalue(diagonal, sides);
        mode.change = std::abs(quotient - mode.quotient) / quotient;
        mode.quotient = quotient;
        ++mode.iterations;
        if (side <= exhausted * quotient) {
            mode.change = 0.0;
            break;
        }
        if (std::isnan(side)) break;  // as is the change: a product is not a number
        if (mode.iterations >= least_iterations && mode.change <= settled_change) break;
        sides.push_back(side);
        each([&](std::ptrdiff_t i) { other[i] /= side; });
        v.swap(other);
    }
    mode.quotient *= unit;
    return mode;
}

}  // namespace abut::dynamics
