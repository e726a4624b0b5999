#include "abut/mesh/io/read_surface.hpp"

#include <limits>
#include <new>
#include <stdexcept>

#include "abut/mesh/io/other_formats.hpp"
#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

SurfaceMesh read_by_extension(const std::filesystem::path& path, const std::string& extension,
                              const SurfaceOptions& options) {
    if (extension == ".obj") return read_obj_surface(path);
    if (extension == ".off") return read_off_surface(path);
    if (extension == ".ply") return read_ply_surface(path);
    if (extension == ".stl") return read_stl_surface(path);
    if (extension == ".vtp") return read_vtp_surface(path, options);
    if (extension == ".vtu") return read_vtu_surface(path, options);
    if (extension == ".msh") return read_gmsh_surface(path, options);
    throw MeshError(path.string() + ": " +
                    about_extension(path, ".vtu", "a surface file, .obj, .off, .ply, .stl, .vtp, .vtu and .msh"));
}

SurfaceMesh read_or_refuse(const std::filesystem::path& path, const SurfaceOptions& options) {
    const std::string name = path.string();
    try {
        SurfaceMesh mesh = read_by_extension(path, small_extension(path), options);
        if (mesh.vertices.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
            throw MeshError(name + ": has " + std::to_string(mesh.vertices.size()) +
                            " vertices, at most 2147483647 are allowed. Coarsen the surface.");
        return mesh;
    } catch (const std::bad_alloc&) {
        throw MeshError(name +
                        ": the memory of this machine is too small for what the file holds or promises. See that the "
                        "file is whole, or coarsen the surface.");
    } catch (const std::length_error& error) {
        throw MeshError(name + ": " + error.what());
    }
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
    SurfaceMesh mesh = read_or_refuse(path, options);
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
