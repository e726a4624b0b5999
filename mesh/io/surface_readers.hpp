#pragma once
// Private to the layer; not installed. What read_surface is made of: each fills vertices, faces and, where the file has
// them, labels, bodies and displacement. Errors: see read_surface.
#include <filesystem>

#include "abut/mesh/io/read_surface.hpp"

namespace abut::mesh {

/// .obj, .off, .ply, .stl; `extension` in small letters.
[[nodiscard]] SurfaceMesh read_polygon_file(const std::filesystem::path& path, const std::string& extension);
[[nodiscard]] SurfaceMesh read_vtp_surface(const std::filesystem::path& path, const SurfaceOptions& options);
[[nodiscard]] SurfaceMesh read_vtu_surface(const std::filesystem::path& path, const SurfaceOptions& options);
[[nodiscard]] SurfaceMesh read_gmsh_surface(const std::filesystem::path& path, const SurfaceOptions& options);

}  // namespace abut::mesh
