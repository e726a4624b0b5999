#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "abut/base/parallel.hpp"
#include "abut/base/vector.hpp"

namespace abut::solid {
namespace detail {

/// Midpoints of a few cells, and the norm of the largest |b - a| of each component; NaN if there is one. Absolute values are
/// compared by their bits, which keep the order of numbers with NaN above infinity: the loop has no branch.
template <int Dim>
double take_midpoints(std::span<const double> a, std::span<const double> b, std::span<double> middle) {
    constexpr std::size_t lanes = 8 * Dim;
    std::array<std::int64_t, lanes> top{};
    const auto take = [&](std::size_t i, std::size_t lane) {
        middle[i] = 0.5 * (a[i] + b[i]);
        top[lane] = std::max(top[lane], std::bit_cast<std::int64_t>(std::abs(b[i] - a[i])));
    };
    std::size_t i = 0;
    for (; i + lanes <= a.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) take(i + lane, lane);
    for (std::size_t lane = 0; i + lane < a.size(); ++lane) take(i + lane, lane);
    double squares = 0.0;
    for (std::size_t k = 0; k < Dim; ++k) {
        std::int64_t largest = 0;
        for (std::size_t lane = k; lane < lanes; lane += Dim) largest = std::max(largest, top[lane]);
        squares += std::bit_cast<double>(largest) * std::bit_cast<double>(largest);
    }
    return std::sqrt(squares);
}

}  // namespace detail

/// Midpoints of cells that move from a to b. No cell moves farther than what is returned: of some neighbours in the order of
/// cells, the norm of the largest motion along each axis; NaN if a number is.
template <int Dim>
double take_midpoints(std::span<const Vector<Dim>> a, std::span<const Vector<Dim>> b, std::span<Vector<Dim>> middle) {
    const auto n = static_cast<std::ptrdiff_t>(a.size());
    return largest((n + parallel_grain - 1) / parallel_grain,
                   [&](std::ptrdiff_t block) {
                       const std::ptrdiff_t begin = block * parallel_grain, size = std::min(parallel_grain, n - begin);
                       const auto numbers = [&](auto& vectors) {
                           return std::span(vectors[static_cast<std::size_t>(begin)].data(),
                                            static_cast<std::size_t>(size * Dim));
                       };
                       return detail::take_midpoints<Dim>(numbers(a), numbers(b), numbers(middle));
                   },
                   1);
}

}  // namespace abut::solid
