#pragma once
// Private to the layer; not installed. What read_surface is made of: each fills vertices, faces and, where the file has
// them, labels, bodies and displacement. Errors: see read_surface.
#include <filesystem>

#include "abut/mesh/io/read_surface.hpp"

namespace abut::mesh {

[[nodiscard]] SurfaceMesh read_obj_surface(const std::filesystem::path& path);
[[nodiscard]] SurfaceMesh read_off_surface(const std::filesystem::path& path);
[[nodiscard]] SurfaceMesh read_ply_surface(const std::filesystem::path& path);
[[nodiscard]] SurfaceMesh read_stl_surface(const std::filesystem::path& path);
[[nodiscard]] SurfaceMesh read_vtp_surface(const std::filesystem::path& path, const SurfaceOptions& options);
[[nodiscard]] SurfaceMesh read_vtu_surface(const std::filesystem::path& path, const SurfaceOptions& options);
[[nodiscard]] SurfaceMesh read_gmsh_surface(const std::filesystem::path& path, const SurfaceOptions& options);

}  // namespace abut::mesh
