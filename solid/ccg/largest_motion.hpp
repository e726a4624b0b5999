#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "abut/base/parallel.hpp"
#include "abut/base/vector.hpp"
#include "abut/solid/ccg/lanes.hpp"

namespace abut::solid {
namespace detail {

/// Largest absolute values, by the bits of numbers: these keep their order with NaN above infinity, and no branch is needed.
template <int Dim>
class LargestBits {
public:
    void take(Lanes<Dim> a) {
        const Bits bits = reinterpret_cast<Bits>(a.r) & no_sign;
        top_ = bits > top_ ? bits : top_;
    }
    /// Norm of the largest of each component; NaN if there is one.
    [[nodiscard]] double norm() const {
        double squares = 0.0;
        for (int j = 0; j < Dim; ++j) {
            const auto largest = std::bit_cast<double>(static_cast<std::int64_t>(top_[j]));
            squares += largest * largest;
        }
        return std::sqrt(squares);
    }

private:
    using Bits = std::conditional_t<Dim == 2, std::int64_t __attribute__((vector_size(16))),
                                    std::int64_t __attribute__((vector_size(32)))>;
    static constexpr std::int64_t no_sign = std::numeric_limits<std::int64_t>::max();

    Bits top_{};
};

}  // namespace detail

/// No cell moves farther from a to b than this: of some neighbours in the order of cells, the norm of the largest
/// motion along each axis; NaN if a number is.
template <int Dim>
[[nodiscard]] double largest_motion(std::span<const Vector<Dim>> a, std::span<const Vector<Dim>> b) {
    const auto n = static_cast<std::ptrdiff_t>(a.size());
    const auto of_block = [&](std::ptrdiff_t block) {
        detail::LargestBits<Dim> motion;
        for (std::ptrdiff_t c = block * parallel_grain; c < std::min(n, (block + 1) * parallel_grain); ++c)
            motion.take(load_packed<Dim>(b[c]) - load_packed<Dim>(a[c]));
        return motion.norm();
    };
    return largest((n + parallel_grain - 1) / parallel_grain, of_block, 1);
}

}  // namespace abut::solid
