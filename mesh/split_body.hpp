#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// The bodies of a mesh cut along its faces into others: `part_of` says of each cell which of `names` it belongs to
/// (n_cells). Each has vertices of its own, and BuildReport::joined_bodies says which have faces in common. Groups of
/// boundary faces are as they were. Throws BadInput for another number of cells, a part that does not exist, or one
/// without cells.
template <int Dim>
[[nodiscard]] Mesh<Dim> split_body(const Mesh<Dim>& mesh, std::span<const std::int32_t> part_of,
                                   std::vector<std::string> names);

}  // namespace abut::mesh
