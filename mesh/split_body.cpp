#include "abut/mesh/split_body.hpp"

#include <utility>

#include "abut/base/error.hpp"

namespace abut::mesh {
namespace {

template <int Dim>
CellSoup<Dim> soup_of(const Mesh<Dim>& mesh) {
    CellSoup<Dim> soup;
    soup.name = mesh.name;
    soup.vertices = mesh.vertices;
    soup.cell_shape = mesh.cell_shape;
    soup.cell_vertices = mesh.cell_vertices;
    soup.cell_label = mesh.cell_label;
    soup.vertex_label = mesh.vertex_label;
    soup.n_ignored_elements = mesh.report.n_ignored_elements;
    soup.warnings = mesh.report.warnings;
    for (const BoundaryGroup& group : mesh.groups) {
        const auto number = static_cast<std::int32_t>(soup.group_names.size());
        soup.group_names.push_back(group.name);
        for (const std::int32_t face : group.faces) {
            const auto corners = mesh.face_vertices[face];
            soup.named_faces.push_back({{corners.begin(), corners.end()}, number});
        }
    }
    return soup;
}

}  // namespace

template <int Dim>
Mesh<Dim> split_body(const Mesh<Dim>& mesh, std::span<const std::int32_t> part_of, std::vector<std::string> names) {
    if (std::ssize(part_of) != mesh.n_cells())
        throw BadInput(mesh.name + ": parts of " + std::to_string(part_of.size()) + " cells are given for " +
                           std::to_string(mesh.n_cells()) + "; give one per cell.",
                       {.value = static_cast<double>(part_of.size()), .allowed = static_cast<double>(mesh.n_cells())});
    CellSoup<Dim> soup = soup_of(mesh);
    soup.cell_body.assign(part_of.begin(), part_of.end());
    soup.body_names = std::move(names);
    Mesh<Dim> split = build_mesh(std::move(soup),
                                 {.planarity_tolerance = 2.0 * mesh.report.worst_planarity + geometry::planarity_tolerance,
                                  .shared_vertices = SharedVertices::separate});
    auto joined = std::move(split.report.joined_bodies);
    split.report = mesh.report;
    split.report.joined_bodies = std::move(joined);
    return split;
}

template Mesh<2> split_body(const Mesh<2>&, std::span<const std::int32_t>, std::vector<std::string>);
template Mesh<3> split_body(const Mesh<3>&, std::span<const std::int32_t>, std::vector<std::string>);

}  // namespace abut::mesh
