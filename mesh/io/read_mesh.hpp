#pragma once
#include <filesystem>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Reads a mesh file by its extension: .msh with read_gmsh, .vtu with read_vtu. Throws MeshError for any other.
template <int Dim>
[[nodiscard]] Mesh<Dim> read_mesh(const std::filesystem::path& path, const MeshOptions& options = {});

}  // namespace abut::mesh
