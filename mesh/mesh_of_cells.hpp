#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Some cells of a mesh, increasing, as a mesh: its cells and faces come in the order that they have there, and it has all
/// bodies and groups. A face whose other cell is left out is a boundary face.
template <int Dim>
[[nodiscard]] Mesh<Dim> mesh_of_cells(const Mesh<Dim>& mesh, const std::vector<std::int32_t>& cells);

}  // namespace abut::mesh
