#pragma once
#include <string>

#include "abut/mesh/mesh.hpp"
#include "abut/mesh/surface_mesh.hpp"

namespace abut::mesh {

/// Which take minutes.
inline constexpr double most_filled_cells = 5e6;

struct FillOptions {
    double size = 0.1;  ///< wanted edge length of cells; with `keeps_triangles` of those away from the surface [m]
    std::string name = "body";
    bool keeps_triangles = false;  ///< those of the surface are faces of the mesh
};

/// Tetrahedra inside a closed surface, by Gmsh: one body, group "boundary". Polygons are cut into triangles, and vertices
/// at one place become one. Calls from several threads wait for
/// one another.
///
/// The surface is remeshed: patches between edges of more than 40 degrees get parameters from the triangles, and
/// triangles of `size`. Sharp edges stay. Where that fails, or fills less than half of the volume, the triangles stay
/// as they are, which BuildReport::warnings tells. It also tells of a volume that is off by more than a tenth.
///
/// Throws MeshError if a face cannot be used, if the surface has a rim, if an edge belongs to more than
/// two faces or two faces run along it the same way, if it is in several parts, if `size` is not above 0, if the cells
/// by their estimate would be more than `most_filled_cells` (or MeshOptions::most_cells), before anything is made, and
/// if Gmsh fails, as where the surface cuts itself.
[[nodiscard]] Mesh<3> fill(const SurfaceMesh& surface, const FillOptions& options, const MeshOptions& mesh_options = {});

}  // namespace abut::mesh
