#include "abut/mesh/without_cells.hpp"

#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/mesh/mesh_of_cells.hpp"

namespace abut::mesh {

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
    return left;
}

template MeshLeft<2> without_cells(const Mesh<2>&, std::span<const std::int32_t>);
template MeshLeft<3> without_cells(const Mesh<3>&, std::span<const std::int32_t>);

}  // namespace abut::mesh
