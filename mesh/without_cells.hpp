#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Remaining part of a mesh.
template <int Dim>
struct MeshLeft {
    Mesh<Dim> mesh;
    std::vector<std::int32_t> old_cells;  ///< of each cell its number in the mesh before, increasing (n_cells)
};

/// A mesh without some of its cells, in any order. Those that are left keep their order, corners and labels, bodies and
/// groups are all there; faces behind a cell that is gone are boundary faces of no group. Throws BadInput for a cell that
/// does not exist, or is given twice, and for a body of which nothing would be left.
template <int Dim>
[[nodiscard]] MeshLeft<Dim> without_cells(const Mesh<Dim>& mesh, std::span<const std::int32_t> cells);

/// Numbers that the vertices of such a mesh had in the one before it (n_vertices of `left`), and those of its faces
/// (n_faces). `old_cells`: of each of its cells the number there, as MeshLeft has it.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> old_vertices(const Mesh<Dim>& before, const Mesh<Dim>& left,
                                                     std::span<const std::int32_t> old_cells);
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> old_faces(const Mesh<Dim>& before, const Mesh<Dim>& left,
                                                  std::span<const std::int32_t> old_cells);

}  // namespace abut::mesh
