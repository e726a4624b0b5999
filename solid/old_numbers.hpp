#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// Numbers that the faces of a mesh had in another one, by where their corners are; -1: there was no such face.
/// `old_cells`: of each cell its number there. Throws BadInput for a cell of another shape or place.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> old_faces(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after,
                                                  std::span<const std::int32_t> old_cells);

/// The boundary faces of those, by their indices among the boundary faces of both; -1, too, for one that was inside.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> old_boundary_faces(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after,
                                                           std::span<const std::int32_t> old_faces);

/// Throws BadInput where such a face has its corners in another order than it had.
template <int Dim>
void check_corners(const mesh::Mesh<Dim>& before, const mesh::Mesh<Dim>& after,
                   std::span<const std::int32_t> old_boundary_faces);

}  // namespace abut::solid
