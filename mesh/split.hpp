#pragma once
// Private to the layer; not installed.

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Looks at every quadrangle of a soup of polyhedra. If some are non-planar and options.non_planar is `split`, their cells
/// are replaced by tetrahedra without new vertices: cones from the cell's smallest vertex to the triangles of the faces
/// opposite to it, every quadrangle cut by the diagonal through its own smallest vertex. Both sides of a face so agree on
/// its diagonal. A cut quadrangle needs cut cells on both sides: cells that share a quadrangle with a cut cell are cut too.
/// Named faces are cut alike; the new cells keep their cell's body and label. Fills the non-planar part of `report`.
/// Throws MeshError naming the worst face when options.non_planar is `fail`. In 2D there is nothing to do.
template <int Dim>
void handle_non_planar_faces(CellSoup<Dim>& soup, const MeshOptions& options, BuildReport& report);

}  // namespace abut::mesh
