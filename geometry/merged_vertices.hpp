#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// For each vertex the smallest index of a vertex with exactly its coordinates (0 and -0 are one number): its own where it
/// is alone or the first. A vertex with a coordinate that is no finite number is alone. n log n.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> merged_vertices(std::span<const Vector<Dim>> vertices);

}  // namespace abut::geometry
