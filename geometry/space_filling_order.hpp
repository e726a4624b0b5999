#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/geometry/vector.hpp"

namespace abut::geometry {

/// The order in which a Hilbert curve visits the points: entry k is the index of the k-th point. Neighbours in the order
/// are near in space, so data stored in it are near in memory. The same points give the same order; coinciding points
/// come one after another. Throws std::invalid_argument naming the point if a coordinate is NaN or infinite.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> space_filling_order(std::span<const Vector<Dim>> points);

}  // namespace abut::geometry
