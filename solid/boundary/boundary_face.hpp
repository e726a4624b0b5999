#pragma once
#include <cstdint>

#include "abut/base/ids.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// Index of a face in Mesh::boundary_faces.
enum class BoundaryFace : std::int32_t {};

/// Stands for no face where a boundary face is named. In a pair of contact it stands for a face of an obstacle.
inline constexpr BoundaryFace no_face{-1};

/// The index that a boundary face has among all faces of the mesh.
template <int Dim>
[[nodiscard]] std::int32_t mesh_face(const mesh::Mesh<Dim>& mesh, BoundaryFace face) {
    return mesh.boundary_faces[static_cast<std::size_t>(face)];
}

/// Its only cell.
template <int Dim>
[[nodiscard]] std::int32_t cell_of(const mesh::Mesh<Dim>& mesh, BoundaryFace face) {
    return mesh.face_cells[mesh_face(mesh, face)][0];
}

/// Distance [m] of a boundary face, by its index among all faces, from the centroid of its cell: (x_f - x_c) . n_f.
template <int Dim>
[[nodiscard]] double cell_depth(const mesh::Mesh<Dim>& mesh, std::int32_t face) {
    return (mesh.face_centroid[face] - mesh.cell_centroid[mesh.face_cells[face][0]]).dot(mesh.face_normal[face]);
}

/// All boundary faces of a mesh.
template <int Dim>
[[nodiscard]] auto boundary_faces(const mesh::Mesh<Dim>& mesh) {
    return all_ids<BoundaryFace>(static_cast<std::int32_t>(mesh.boundary_faces.size()));
}

}  // namespace abut::solid
