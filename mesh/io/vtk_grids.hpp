#pragma once
// Private to the layer; not installed.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/io/vtk_output.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// 0, 1, ... n-1
[[nodiscard]] std::vector<std::int32_t> all_of(std::size_t n);
/// The vertices of these boundary faces, given by their index in Mesh::boundary_faces, in the order in which they name them.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> surface_vertices(const Mesh<Dim>& mesh, std::span<const std::int32_t> boundary);

/// The array that says which boundary faces are in a group.
[[nodiscard]] std::string group_array(const std::string& group);

/// These cells on these vertices of theirs, with the cell array "body", and the number "body: <name>" of each body.
template <int Dim>
[[nodiscard]] OutputGrid grid_of_cells(const Mesh<Dim>& mesh, std::span<const std::int32_t> cells,
                                       std::span<const std::int32_t> vertices);
/// Grid of boundary faces, with a cell array for each group of the mesh.
template <int Dim>
[[nodiscard]] OutputGrid grid_of_surface(const Mesh<Dim>& mesh, std::span<const std::int32_t> boundary,
                                         std::span<const std::int32_t> vertices);
/// All cells, and behind them the boundary faces that are in groups as cells of one dimension less, with a cell array
/// for each group of the mesh.
template <int Dim>
[[nodiscard]] OutputGrid grid_with_groups(const Mesh<Dim>& mesh);

}  // namespace abut::mesh
