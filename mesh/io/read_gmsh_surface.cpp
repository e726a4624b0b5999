#include <algorithm>

#include "abut/base/sort_unique.hpp"
#include "abut/mesh/io/gmsh_session.hpp"
#include "abut/mesh/io/read_gmsh.hpp"
#include "abut/mesh/io/surface_readers.hpp"

namespace abut::mesh {
namespace {

/// Drops the names of groups without faces; faces outside any group make one more body, called like the file.
void take_bodies(SurfaceMesh& mesh, const CellSoup<3>& soup, const std::string& rest) {
    std::vector<std::int32_t> used = soup.cell_body;  // -1 outside any group
    sort_unique(used);
    for (const std::int32_t group : used)
        mesh.body_names.push_back(group < 0 ? rest : soup.body_names[static_cast<std::size_t>(group)]);
    for (const std::int32_t group : soup.cell_body)
        mesh.face_body.push_back(
            static_cast<std::int32_t>(std::lower_bound(used.begin(), used.end(), group) - used.begin()));
}

}  // namespace

SurfaceMesh read_gmsh_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
    bool has_volume = false;
    CellSoup<3> soup;
    in_gmsh_file(path, [&] {
        has_volume = has_gmsh_elements(3);
        if (!has_volume) soup = surface_of_gmsh_model(path.string());
        soup.warnings = GmshSession::warnings();
    });
    if (has_volume) return boundary_of(read_gmsh<3>(path, options.volume));
    SurfaceMesh mesh;
    mesh.name = path.string();
    take_bodies(mesh, soup, path.stem().string());
    mesh.vertices = std::move(soup.vertices);
    mesh.faces = std::move(soup.cell_vertices);
    mesh.face_label = std::move(soup.cell_label);
    mesh.n_ignored_elements = soup.n_ignored_elements;
    mesh.warnings = std::move(soup.warnings);
    return mesh;
}

}  // namespace abut::mesh
