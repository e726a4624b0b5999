#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Part of a mesh that one of several ranks has: its own cells, and copies of others, which other ranks own. Cells and
/// faces come in the order that they have in the whole mesh, bodies and groups are all there. Where the part ends inside a
/// body, its outermost copies have boundary faces that the whole mesh does not have.
template <int Dim>
struct MeshPart {
    Mesh<Dim> mesh;
    std::vector<std::int32_t> cell_number;  ///< of each cell in the whole mesh, increasing (n_cells)
    std::vector<int> cell_owner;            ///< the rank that owns it (n_cells)
    std::int32_t n_cells = 0;               ///< of the whole mesh
};

/// Depth of the copies in cells: all that a force on a cell of a linear body depends on, with the operators of solid
/// (solid::copy_layers, docs/ranks.md).
inline constexpr int default_layers = 8;

/// The part of a rank: the cells that it owns, `layers` of neighbours across faces around them, and all cells that share a
/// vertex with own ones. `owner` says whose each cell is (n_cells). Of `whole_bodies` each part has all cells. Throws
/// BadInput where the length of `owner` is another one, for fewer than 1 layer, for a body that does not exist, and for any
/// other body whose cells differ in their number of faces.
template <int Dim>
[[nodiscard]] MeshPart<Dim> part_of(const Mesh<Dim>& mesh, std::span<const int> owner, int rank, int layers = default_layers,
                                    std::span<const std::int32_t> whole_bodies = {});

}  // namespace abut::mesh
