#include "abut/mesh/without_cells.hpp"

#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/mesh/mesh_of_cells.hpp"

namespace abut::mesh {
namespace {

/// Cells keep the order of their vertices and of their faces.
std::vector<std::int32_t> old_numbers(const Rows& before, const Rows& left, std::size_t n,
                                      std::span<const std::int32_t> old_cells) {
    std::vector<std::int32_t> old(n);
    for (std::int32_t c = 0; c < left.size(); ++c) {
        const auto now = left[c], was = before[old_cells[static_cast<std::size_t>(c)]];
        for (std::size_t i = 0; i < now.size(); ++i) old[static_cast<std::size_t>(now[i])] = was[i];
    }
    return old;
}

}  // namespace

template <int Dim>
MeshLeft<Dim> without_cells(const Mesh<Dim>& mesh, std::span<const std::int32_t> cells) {
    std::vector<char> is_gone(mesh.cell_measure.size(), 0), has_cells(static_cast<std::size_t>(mesh.n_bodies()), 0);
    for (const std::int32_t c : cells)
        if (c < 0 || c >= mesh.n_cells() || std::exchange(is_gone[static_cast<std::size_t>(c)], 1) != 0)
            throw BadInput(mesh.name + ": cell " + std::to_string(c) + " is to be taken out, which " +
                               (c < 0 || c >= mesh.n_cells() ? "does not exist; cells are counted from 0 to " +
                                                                   std::to_string(mesh.n_cells() - 1) + "."
                                                             : "is given twice."),
                           {.cell = c});
    MeshLeft<Dim> left;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (is_gone[static_cast<std::size_t>(c)] == 0) {
            left.old_cells.push_back(c);
            has_cells[static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(c)])] = 1;
        }
    for (std::size_t body = 0; body < has_cells.size(); ++body)
        if (has_cells[body] == 0)
            throw BadInput(mesh.name + ": all cells of body '" + mesh.body_names[body] +
                           "' are to be taken out. Leave one at least.");
    left.mesh = mesh_of_cells(mesh, left.old_cells);
    left.mesh.has_lost_cells = mesh.has_lost_cells || left.mesh.n_cells() < mesh.n_cells();
    return left;
}

template <int Dim>
std::vector<std::int32_t> old_vertices(const Mesh<Dim>& before, const Mesh<Dim>& left,
                                       std::span<const std::int32_t> old_cells) {
    return old_numbers(before.cell_vertices, left.cell_vertices, left.vertices.size(), old_cells);
}

template <int Dim>
std::vector<std::int32_t> old_faces(const Mesh<Dim>& before, const Mesh<Dim>& left,
                                    std::span<const std::int32_t> old_cells) {
    return old_numbers(before.cell_faces, left.cell_faces, left.face_measure.size(), old_cells);
}

#define ABUT_INSTANTIATE(Dim)                                                                                           \
    template MeshLeft<Dim> without_cells(const Mesh<Dim>&, std::span<const std::int32_t>);                              \
    template std::vector<std::int32_t> old_vertices(const Mesh<Dim>&, const Mesh<Dim>&, std::span<const std::int32_t>); \
    template std::vector<std::int32_t> old_faces(const Mesh<Dim>&, const Mesh<Dim>&, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::mesh
