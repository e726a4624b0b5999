#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>

#include "abut/base/parallel.hpp"
#include "abut/base/vector.hpp"
#include "abut/solid/operator/lanes.hpp"

namespace abut::solid {
namespace detail {

/// Largest motion along each axis of some points, two at a time: their numbers fill Dim registers, in which each lane always
/// has the same axis.
template <int Dim>
class LargestMotion {
public:
    /// Points whose numbers are in a row.
    void take(const double* from, const double* to, std::ptrdiff_t n) {
        for (std::ptrdiff_t i = 0; i + 1 < n; i += 2)
            for (int k = 0; k < Dim; ++k) take(k, load(to + Dim * i + 2 * k) - load(from + Dim * i + 2 * k));
        if (n % 2 == 0) return;
        std::array<double, 2 * Dim> last{};
        for (std::ptrdiff_t k = 0; k < Dim; ++k) last[k] = to[Dim * (n - 1) + k] - from[Dim * (n - 1) + k];
        for (int k = 0; k < Dim; ++k) take(k, load(last.data() + 2 * k));
    }
    /// Norm of the largest of each axis; NaN where a number is not finite.
    [[nodiscard]] double norm() const {
        std::array<double, Dim> largest{};
        double squares = 0.0;
        for (int i = 0; i < 2 * Dim; ++i) {
            largest[i % Dim] = std::max(largest[i % Dim], top_[i / 2][i % 2]);
            squares += not_finite_[i / 2][i % 2];
        }
        for (const double of_axis : largest) squares += of_axis * of_axis;
        return std::sqrt(squares);
    }

private:
    static Register2 load(const double* numbers) {
        Register2 two;
        std::memcpy(&two, numbers, sizeof two);
        return two;
    }
    void take(int k, Register2 motion) {
        not_finite_[k] += motion - motion;  // 0, or NaN
        const Register2 forth = motion > top_[k] ? motion : top_[k];
        top_[k] = -motion > forth ? -motion : forth;
    }

    std::array<Register2, Dim> top_{}, not_finite_{};
};

}  // namespace detail

/// No cell moves farther from a to b than this: of some neighbours in the order of cells, the norm of the largest
/// motion along each axis; NaN if a number is not finite.
template <int Dim>
[[nodiscard]] double largest_motion(std::span<const Vector<Dim>> a, std::span<const Vector<Dim>> b) {
    const auto n = static_cast<std::ptrdiff_t>(a.size());
    const auto of_block = [&](std::ptrdiff_t block) {
        const std::ptrdiff_t first = block * parallel_grain;
        detail::LargestMotion<Dim> motion;
        motion.take(a[first].data(), b[first].data(), std::min(n - first, parallel_grain));
        return motion.norm();
    };
    return largest((n + parallel_grain - 1) / parallel_grain, of_block, 1);
}

}  // namespace abut::solid
