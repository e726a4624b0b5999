#pragma once
// Private to the sources of the layers.
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

// Passing wide vectors by value has no fixed ABI where the processor lacks them; everything here is inlined within one file.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace abut {

/// One number of several pairs side by side, as many as the processor takes at once: what is done to one is done to all. No
/// lane knows of the others, so a result depends neither on their number nor on who stands beside it.
#if defined(__AVX512F__)
using Lanes = double __attribute__((vector_size(64)));
#elif defined(__AVX__)
using Lanes = double __attribute__((vector_size(32)));
#else
using Lanes = double __attribute__((vector_size(16)));
#endif

/// One answer per lane, all bits set for yes: of a comparison of Lanes. `mask ? a : b` picks lane by lane.
using LaneMask = decltype(Lanes{} < Lanes{});

inline constexpr int lane_count = sizeof(Lanes) / sizeof(double);

[[nodiscard]] inline Lanes load_lanes(const double* values) {
    Lanes lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
}
inline void store_lanes(Lanes lanes, double* values) { std::memcpy(values, &lanes, sizeof lanes); }

[[nodiscard]] inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }

[[nodiscard]] inline Lanes absolute(Lanes a) {
    return std::bit_cast<Lanes>(std::bit_cast<LaneMask>(a) & INT64_C(0x7fffffffffffffff));
}

/// a where the mask says yes, else 0. GCC takes some selections between constants apart bit by bit; not this.
[[nodiscard]] inline Lanes where(LaneMask mask, Lanes a) { return std::bit_cast<Lanes>(std::bit_cast<LaneMask>(a) & mask); }

/// Rounded correctly for every number of lanes: Eigen's of eight is not, it is an estimate improved twice. A loop over
/// std::sqrt would ask for errno.
[[nodiscard]] inline Lanes square_root(Lanes a) {
#if defined(__AVX512F__)
    return _mm512_sqrt_pd(a);
#elif defined(__AVX__)
    return _mm256_sqrt_pd(a);
#elif defined(__SSE2__)
    return _mm_sqrt_pd(a);
#else
    for (int k = 0; k < lane_count; ++k) a[k] = std::sqrt(a[k]);
    return a;
#endif
}

/// Rounding error of a - b: the rounded difference and this add up to a - b exactly (Knuth).
[[nodiscard]] inline Lanes difference_error(Lanes a, Lanes b) {
    const Lanes difference = a - b, of_b = a - difference;
    return (a - (difference + of_b)) + (of_b - b);
}

/// Rounding error of a b, exact where neither overflows nor underflows: bitwise identical with fused multiply-add and
/// without, where the factors are cut in halves whose products are doubles (Dekker).
[[nodiscard]] inline Lanes product_error(Lanes a, Lanes b) {
#if defined(__AVX512F__)
    return _mm512_fmsub_pd(a, b, a * b);
#elif defined(__FMA__) && defined(__AVX__)
    return _mm256_fmsub_pd(a, b, a * b);
#else
    constexpr double cut = 0x1p27 + 1.0;
    const Lanes high_a = cut * a - (cut * a - a), high_b = cut * b - (cut * b - b);
    const Lanes low_a = a - high_a, low_b = b - high_b;
    return ((high_a * high_b - a * b) + high_a * low_b + low_a * high_b) + low_a * low_b;
#endif
}

/// Bit k is set where lane k says yes.
[[nodiscard]] inline std::uint32_t bits_of(LaneMask mask) {
#if defined(__AVX512F__)
    return _mm512_cmplt_epi64_mask(std::bit_cast<__m512i>(mask), _mm512_setzero_si512());
#elif defined(__AVX__)
    return static_cast<std::uint32_t>(_mm256_movemask_pd(std::bit_cast<__m256d>(mask)));
#elif defined(__SSE2__)
    return static_cast<std::uint32_t>(_mm_movemask_pd(std::bit_cast<__m128d>(mask)));
#else
    std::uint32_t bits = 0;
    for (int k = 0; k < lane_count; ++k) bits |= mask[k] != 0 ? 1u << k : 0u;
    return bits;
#endif
}

[[nodiscard]] inline bool any(LaneMask mask) { return bits_of(mask) != 0; }

}  // namespace abut
