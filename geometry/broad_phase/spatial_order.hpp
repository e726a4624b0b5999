#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Indices of the points in an order in which points that follow one another are near each other: along a Morton curve
/// through their bounding box, and through that of any 32 or more that it leaves in one of its cells. Points at one position
/// keep their order. The same for any number of threads. Throws BadInput naming the point if a coordinate is
/// NaN or infinite.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> spatial_order(std::span<const Vector<Dim>> points);

}  // namespace abut::geometry
