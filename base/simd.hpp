#pragma once
// Private to the sources of the layers.
#include <Eigen/Core>
#include <bit>
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

[[nodiscard]] inline Lanes square_root(Lanes a) {
    Eigen::Array<double, lane_count, 1> values;  // knows the instruction; a loop over std::sqrt would ask for errno
    store_lanes(a, values.data());
    values = values.sqrt();
    return load_lanes(values.data());
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
