#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Gives each body vertices of its own where several share them. A named face between two bodies becomes one of each.
/// Returns the pairs of bodies that had a face in common, increasing, the lower one first.
template <int Dim>
[[nodiscard]] std::vector<std::array<std::int32_t, 2>> give_own_vertices(CellSoup<Dim>& soup);

}  // namespace abut::mesh
