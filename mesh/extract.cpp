#include "abut/mesh/extract.hpp"

#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/chosen_rows.hpp"

namespace abut::mesh {

template <int Dim>
Mesh<Dim> extract_bodies(const Mesh<Dim>& mesh, std::span<const std::int32_t> bodies) {
    std::vector<std::int32_t> new_body(static_cast<std::size_t>(mesh.n_bodies()), not_chosen);
    std::int32_t last = not_chosen, n = 0;
    for (const std::int32_t body : bodies) {
        if (body <= last || body >= mesh.n_bodies())
            throw BadInput(mesh.name + ": body " + std::to_string(body) + " is asked for after " + std::to_string(last) +
                           "; give bodies in increasing order, from 0 to " + std::to_string(mesh.n_bodies() - 1) + ".");
        new_body[static_cast<std::size_t>(body)] = n++;
        last = body;
    }

    std::vector<std::int32_t> cells, faces;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (new_body[mesh.cell_body[c]] != not_chosen) cells.push_back(c);
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
        if (new_body[mesh.cell_body[mesh.face_cells[f][0]]] != not_chosen) faces.push_back(f);
    const std::vector<std::int32_t> vertices = vertices_of(mesh, cells);
    const auto new_cell = new_numbers(mesh.cell_measure.size(), cells);
    const auto new_face = new_numbers(mesh.face_measure.size(), faces);
    const auto new_vertex = new_numbers(mesh.vertices.size(), vertices);

    Mesh<Dim> part;
    set_cells(mesh, cells, vertices, new_face, new_vertex, part);
    for (const std::int32_t c : cells) part.cell_body.push_back(new_body[mesh.cell_body[c]]);
    part.face_vertices = chosen_rows(mesh.face_vertices, faces, new_vertex);
    for (const std::int32_t f : faces) {
        const auto [first, second] = mesh.face_cells[f];
        part.face_cells.push_back({new_cell[first], second < 0 ? not_chosen : new_cell[second]});
    }
    part.face_measure = chosen_values(mesh.face_measure, faces);
    part.face_centroid = chosen_values(mesh.face_centroid, faces);
    part.face_normal = chosen_values(mesh.face_normal, faces);
    for (const std::int32_t f : mesh.boundary_faces)
        if (new_face[f] != not_chosen) part.boundary_faces.push_back(new_face[f]);
    for (const std::int32_t body : bodies) part.body_names.push_back(mesh.body_names[body]);
    for (const BoundaryGroup& group : mesh.groups) {
        BoundaryGroup kept{group.name, {}};
        for (const std::int32_t f : group.faces)
            if (new_face[f] != not_chosen) kept.faces.push_back(new_face[f]);
        if (!kept.faces.empty()) part.groups.push_back(std::move(kept));
    }
    return part;
}

template Mesh<2> extract_bodies<2>(const Mesh<2>&, std::span<const std::int32_t>);
template Mesh<3> extract_bodies<3>(const Mesh<3>&, std::span<const std::int32_t>);

}  // namespace abut::mesh
