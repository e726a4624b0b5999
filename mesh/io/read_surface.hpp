#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "abut/mesh/mesh.hpp"
#include "abut/mesh/surface_mesh.hpp"

namespace abut::mesh {

struct SurfaceOptions {
    /// Whether vertices at exactly one place become one (see `weld`). Unset: of .stl only, which knows no shared vertices.
    std::optional<bool> weld{};
    /// The point array of three components that holds the displacement in .vtp and .vtu; empty: read none. That a file has
    /// no array of the default name is no error.
    std::string displacement = "displacement";
    /// Every connected part a body of its own (see `name_connected_bodies`), whatever the file says.
    bool connected_bodies = false;
    MeshOptions volume{};  ///< for files with cells of dimension 3
};

/// The surface that a file holds, by its extension (in small or capital letters):
/// .obj (polygons), .off (polygons; text), .ply (polygons and strips of triangles; text and binary), .stl (triangles;
/// text and binary), .vtp (polygons and strips), .vtu and .msh (triangles, quadrangles, polygons; or the boundary of
/// the cells if there are any of dimension 3: then read_mesh is what reads, and it refuses bad cells; bodies of .msh
/// that share vertices are one).
///
/// Faces are kept as they are, however bad, with the exception that an .obj or .off file with a vertex index out of
/// range or a coordinate that is no finite number is an error. Bodies: the cell array "body" of .vtp and .vtu
/// ("body_<value>"); the physical groups of .msh; else one, called like the file. Elements that are no faces are
/// counted in n_ignored_elements; other parts that are skipped (unknown statements of .obj, a rest behind what a head
/// promises) are in `warnings`.
///
/// Throws MeshError with the file, the line (of text) or the byte (of binary .ply), the reason and the remedy: missing,
/// empty, truncated, garbage, no face, an unknown extension, a displacement that is not finite or has not three
/// components. Memory is taken for what a file holds, not for what it promises.
[[nodiscard]] SurfaceMesh read_surface(const std::filesystem::path& path, const SurfaceOptions& options = {});

}  // namespace abut::mesh
