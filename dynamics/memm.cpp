#include "abut/dynamics/memm.hpp"

#include <algorithm>

#include "abut/dynamics/parallel.hpp"
#include "abut/geometry/messages.hpp"

namespace abut::dynamics::detail {

void add_scaled_velocity(std::span<const double> a, double s, std::span<const double> inverse_mass,
                         std::span<const double> p, std::span<double> result) {
    parallel_each(static_cast<std::ptrdiff_t>(a.size()),
                  [&](std::ptrdiff_t i) { result[i] = a[i] + s * (inverse_mass[i] * p[i]); });
}

void add_scaled(std::span<const double> a, double s, std::span<const double> f, std::span<double> result) {
    parallel_each(static_cast<std::ptrdiff_t>(a.size()), [&](std::ptrdiff_t i) { result[i] = a[i] + s * f[i]; });
}

double half_product(std::span<const double> a, std::span<const double> inverse_mass, std::span<const double> b) {
    return 0.5 * ordered_sum(static_cast<std::ptrdiff_t>(a.size()), 0.0,
                             [&](std::ptrdiff_t i) { return a[i] * inverse_mass[i] * b[i]; });
}

void refuse_step(double dt) {
    throw std::invalid_argument("time step is " + number(dt) +
                                " s; it must be finite and > 0. `stable_step` says how large it may be.");
}

}  // namespace abut::dynamics::detail
