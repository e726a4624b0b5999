#pragma once
#include <string>

#include "abut/mesh/mesh.hpp"
#include "abut/mesh/surface_mesh.hpp"

namespace abut::mesh {

/// Which take minutes.
inline constexpr double most_filled_cells = 5e6;

struct FillOptions {
    double size = 0.1;  ///< wanted edge length of cells away from the surface [m]
    std::string name = "body";
};

/// Tetrahedra inside a closed surface of triangles, by Gmsh: one body, group "boundary". The triangles stay as they are, so
/// that cells beside them are as large as these. Calls from several threads wait for one another.
///
/// Throws MeshError if a face is no triangle or cannot be used, if the surface has a rim, if an edge belongs to more than
/// two faces or two faces run along it the same way, if it is in several parts, if `size` is not above 0, if the cells by their estimate
/// would be more than `most_filled_cells` (or MeshOptions::most_cells), before anything is made, and if Gmsh
/// fails, as where the surface cuts itself.
[[nodiscard]] Mesh<3> fill(const SurfaceMesh& surface, const FillOptions& options, const MeshOptions& mesh_options = {});

}  // namespace abut::mesh
