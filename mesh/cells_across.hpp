#pragma once
#include <cstdint>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// The number of cells across each body where it is thickest, rounded up to an even number (n_bodies): twice the layers of
/// cells from its boundary to its middle. A layer is made of the cells that have a vertex in common with the layer
/// before it.
template <int Dim>
[[nodiscard]] std::vector<int> cells_across(const Mesh<Dim>& mesh);

}  // namespace abut::mesh
