#include "abut/mesh/io/read_surface.hpp"

#include <algorithm>
#include <cctype>

#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

std::string small_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension;
}

SurfaceMesh read_by_extension(const std::filesystem::path& path, const std::string& extension,
                              const SurfaceOptions& options) {
    if (extension == ".vtp") return read_vtp_surface(path, options);
    if (extension == ".vtu") return read_vtu_surface(path, options);
    if (extension == ".msh") return read_gmsh_surface(path, options);
    for (const char* known : {".obj", ".off", ".ply", ".stl"})
        if (extension == known) return read_polygon_file(path, extension);
    throw MeshError(path.string() + ": the extension '" + path.extension().string() +
                    "' is none of a surface file, .obj, .off, .ply, .stl, .vtp, .vtu and .msh can be read. Convert the file "
                    "or rename it.");
}

void check_displacement(const SurfaceMesh& mesh) {
    for (std::size_t v = 0; v < mesh.displacement.size(); ++v)
        if (!mesh.displacement[v].allFinite())
            throw MeshError(mesh.name + ": the displacement of vertex " + std::to_string(v) +
                            " is no finite vector. Correct the array, or read none (SurfaceOptions::displacement).");
}

}  // namespace

SurfaceMesh read_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
    const std::string extension = small_extension(path);
    SurfaceMesh mesh = read_by_extension(path, extension, options);
    mesh.name = path.string();
    if (mesh.faces.size() == 0)
        throw MeshError(mesh.name + ": the surface is empty: the file has 0 faces, at least 1 is needed (" +
                        std::to_string(mesh.vertices.size()) + " vertices, " + std::to_string(mesh.n_ignored_elements) +
                        " elements that are no faces). Write the surface again.");
    check_displacement(mesh);
    if (mesh.body_names.empty()) {
        mesh.body_names = {path.stem().string()};
        mesh.face_body.assign(static_cast<std::size_t>(mesh.faces.size()), 0);
    }
    if (options.weld.value_or(extension == ".stl")) weld(mesh);
    if (options.connected_bodies) name_connected_bodies(mesh);
    return mesh;
}

}  // namespace abut::mesh
