#pragma once
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/boundary/boundary_conditions.hpp"

/// Boxes for the cases of a single body: every cell shape, structured and from Gmsh.
namespace abut::studies {

/// Cells into which a box is cut: the shapes of mesh::structured_box, and unstructured triangles or tetrahedra from Gmsh.
enum class BoxCells { quadrangles, triangles, hexahedra, tetrahedra, prisms, pyramids, gmsh };

/// "quadrangles"
[[nodiscard]] std::string name_of(BoxCells cells);

/// All that there are in a dimension, the unstructured ones last.
template <int Dim>
[[nodiscard]] std::vector<BoxCells> all_box_cells();

/// A box with groups xmin, xmax, ymin, ...: bricks whose edges are nearest to `size` [m], at least one along each, or cells
/// from Gmsh with edges of about `size`. Throws mesh::MeshError, and BadInput for a shape of another dimension.
template <int Dim>
[[nodiscard]] mesh::Mesh<Dim> box_of(BoxCells cells, const Vector<Dim>& lower, const Vector<Dim>& upper, double size);

/// (|body| / n_cells)^(1/Dim) [m]: compares meshes of different cells.
template <int Dim>
[[nodiscard]] double mean_cell_size(const mesh::Mesh<Dim>& mesh);

/// xmin, xmax, ymin, ...
template <int Dim>
[[nodiscard]] std::vector<std::string> box_sides();

/// u_D = field on all sides of a box.
template <int Dim>
[[nodiscard]] std::vector<solid::DirichletCondition<Dim>> whole_boundary(const solid::Field<Dim>& field);

}  // namespace abut::studies
