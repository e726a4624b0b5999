#pragma once
// Private to the layer; not installed.
#include "abut/mesh/io/msh_file.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// The cells of dimension Dim of a Gmsh file, bodies and boundary groups as read_gmsh documents them. Nodes of order 2 are
/// left out, with a warning. `planarity_tolerance`: see MeshOptions. Throws MeshError: see read_gmsh.
template <int Dim>
[[nodiscard]] CellSoup<Dim> soup_of_msh(MshFile file, double planarity_tolerance);

/// The triangles and quadrangles of a Gmsh file, in space. A body is a physical group of dimension 2; elements outside any
/// group have the body -1. Empty if there are none. Throws MeshError: see read_gmsh.
[[nodiscard]] CellSoup<3> surface_soup_of_msh(MshFile file);

}  // namespace abut::mesh
