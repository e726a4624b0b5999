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

/// Bit k is set where lane k says yes.
[[nodiscard]] inline std::uint32_t bits_of(LaneMask mask) {
    std::uint32_t bits = 0;
    for (int k = 0; k < lane_count; ++k) bits |= mask[k] != 0 ? 1u << k : 0u;
    return bits;
}

[[nodiscard]] inline bool any(LaneMask mask) {
    std::int64_t together = 0;
    for (int k = 0; k < lane_count; ++k) together |= mask[k];
    return together != 0;
}

}  // namespace abut
