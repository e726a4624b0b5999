#include <algorithm>
#include <utility>

#include "abut/base/sort_unique.hpp"
#include "abut/mesh/io/msh_soup.hpp"
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
    MshFile file = read_msh_file(path);
    if (file.n_elements(3) > 0)
        return boundary_of(build_mesh(soup_of_msh<3>(std::move(file), options.volume.planarity_tolerance), options.volume));
    CellSoup<3> soup = surface_soup_of_msh(std::move(file));
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
