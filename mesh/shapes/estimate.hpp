#pragma once
// Private to the layer; not installed.
#include <string>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Throws MeshError if a shape would get more cells than it may: MeshOptions::most_cells, or `usual` where that is
/// unset. To be called before anything is made. `cells` is the estimate, `remedy` what to change: "Raise size".
void check_estimate(const std::string& name, double cells, double usual, const MeshOptions& options,
                    const std::string& remedy);

/// Cells in size^Dim, as counted in Gmsh's meshes: equilateral triangles, tetrahedra of cylinders.
template <int Dim>
constexpr double cells_in_unit = Dim == 2 ? 2.3 : 4.6;

}  // namespace abut::mesh
