#pragma once
// Private to the layer; not installed.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// "(3, 17, 28)": vertices by the number they had in the input.
[[nodiscard]] std::string vertex_list(std::span<const std::int32_t> vertices, const std::vector<std::int64_t>& labels);

/// The checks of `build_mesh` that need no geometry: sizes of the arrays, shapes of dimension Dim, indices in range, finite
/// coordinates, no vertex twice in a cell, at least one cell in all and in each body, distinct names of bodies and of
/// groups. Throws MeshError.
template <int Dim>
void check_soup(const CellSoup<Dim>& soup);
/// Throws MeshError for a vertex in two bodies.
template <int Dim>
void check_bodies_apart(const CellSoup<Dim>& soup);

/// The checks of `build_mesh` on cells: measure above 1e-12 (diameter)^Dim.
template <int Dim>
void check_cells(const CellSoup<Dim>& soup, std::span<const double> cell_measure);

/// The checks of `build_mesh` on faces: measure above 1e-12 (diameter of the cell)^(Dim-1), convex, and the centroid of each
/// cell on the inner side of each of its faces. Whether they are plane has been seen to before (mesh/split.hpp).
template <int Dim>
void check_faces(const Mesh<Dim>& mesh);

/// Throws MeshError if two of the names are the same. `what` is "bodies" or "boundary groups".
void check_distinct(const std::string& mesh_name, const std::string& what, std::vector<std::string> names);

}  // namespace abut::mesh
