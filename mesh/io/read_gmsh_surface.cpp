#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/disjoint_sets.hpp"
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

/// Makes bodies that share vertices one, "left+right": bonded bodies have one surface. Boundary groups go, which may lie
/// between them.
void join_bonded_bodies(CellSoup<3>& soup) {
    DisjointSets bonded(soup.body_names.size());
    std::vector<std::int32_t> body_of_vertex(soup.vertices.size(), -1);
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell)
        for (const std::int32_t vertex : soup.cell_vertices[cell]) {
            auto& body = body_of_vertex[static_cast<std::size_t>(vertex)];
            if (body < 0) body = soup.cell_body[static_cast<std::size_t>(cell)];
            bonded.join(body, soup.cell_body[static_cast<std::size_t>(cell)]);
        }
    std::vector<std::int32_t> number(soup.body_names.size());
    std::vector<std::string> names;
    for (std::size_t body = 0; body < number.size(); ++body) {
        const auto first = static_cast<std::size_t>(bonded.find(static_cast<std::int32_t>(body)));
        if (first == body) {
            number[body] = static_cast<std::int32_t>(names.size());
            names.push_back(soup.body_names[body]);
        } else {
            number[body] = number[first];
            names[static_cast<std::size_t>(number[first])] += "+" + soup.body_names[body];
        }
    }
    soup.body_names = std::move(names);
    for (std::int32_t& body : soup.cell_body) body = number[static_cast<std::size_t>(body)];
    soup.named_faces.clear();
    soup.group_names.clear();
}

}  // namespace

SurfaceMesh read_gmsh_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
    MshFile file = read_msh_file(path);
    if (file.n_elements(3) > 0) {
        CellSoup<3> cells = soup_of_msh<3>(std::move(file), options.volume.planarity_tolerance);
        join_bonded_bodies(cells);
        return boundary_of(build_mesh(std::move(cells), options.volume));
    }
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
