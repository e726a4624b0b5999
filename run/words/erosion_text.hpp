#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/run/values/erosion_report.hpp"
#include "abut/run/values/forward.hpp"

namespace abut::run {

/// Shares of the mass at the start and of the energy in play that cells took along which have left [-].
struct ErodedShares {
    double mass = 0.0;
    double energy = 0.0;  ///< size of what they took of H~ + D - W

    [[nodiscard]] double larger() const { return mass > energy ? mass : energy; }
};
template <int Dim>
[[nodiscard]] ErodedShares eroded_shares(const RunResult<Dim>& result);

/// "12 cells, 0.8 % of the mass, 2.1 % of the energy in play: 10 by strain, 2 as remnants"; empty where none has left.
template <int Dim>
[[nodiscard]] std::string erosion_text(const RunResult<Dim>& result);

/// Number of cells that left for a reason, by its word: "strain", "plastic_strain", "stress", "function", "remnant".
struct ErodedCount {
    const char* reason;
    std::int64_t cells;
};
[[nodiscard]] std::vector<ErodedCount> eroded_counts(std::span<const ErodedCell> cells);

}  // namespace abut::run
