#include "abut/mesh/mesh_of_cells.hpp"

#include <algorithm>
#include <utility>

#include "abut/mesh/chosen_rows.hpp"

namespace abut::mesh {
namespace {

/// Faces of these cells by their first cell among them, then by their position in it: the order of a mesh.
template <int Dim>
std::vector<std::int32_t> faces_of(const Mesh<Dim>& mesh, const std::vector<std::int32_t>& cells) {
    std::vector<std::int32_t> faces;
    std::vector<bool> taken(static_cast<std::size_t>(mesh.n_faces()), false);
    for (const std::int32_t c : cells)
        for (const std::int32_t f : mesh.cell_faces[c])
            if (!taken[static_cast<std::size_t>(f)]) taken[static_cast<std::size_t>(f)] = true, faces.push_back(f);
    return faces;
}

/// Sets the faces of a part: those whose first cell is elsewhere are seen from the other side.
template <int Dim>
void set_faces(const Mesh<Dim>& mesh, const std::vector<std::int32_t>& faces, const std::vector<std::int32_t>& new_cell,
               const std::vector<std::int32_t>& new_vertex, Mesh<Dim>& part) {
    std::vector<std::int32_t> vertices;
    for (const std::int32_t f : faces) {
        auto [first, second] = mesh.face_cells[f];
        first = new_cell[static_cast<std::size_t>(first)];
        second = second < 0 ? not_chosen : new_cell[static_cast<std::size_t>(second)];
        const bool turned = first == not_chosen;
        if (turned) std::swap(first, second);
        vertices.clear();
        for (const std::int32_t v : mesh.face_vertices[f]) vertices.push_back(new_vertex[static_cast<std::size_t>(v)]);
        if (turned) std::reverse(vertices.begin(), vertices.end());
        part.face_vertices.append(vertices);
        part.face_normal.push_back(turned ? Vector<Dim>(-mesh.face_normal[f]) : mesh.face_normal[f]);
        if (second == not_chosen) part.boundary_faces.push_back(static_cast<std::int32_t>(part.face_cells.size()));
        part.face_cells.push_back({first, second});
    }
    part.face_measure = chosen_values(mesh.face_measure, faces);
    part.face_centroid = chosen_values(mesh.face_centroid, faces);
}

}  // namespace

template <int Dim>
Mesh<Dim> mesh_of_cells(const Mesh<Dim>& mesh, const std::vector<std::int32_t>& cells) {
    const std::vector<std::int32_t> faces = faces_of(mesh, cells), vertices = vertices_of(mesh, cells);
    const auto new_cell = new_numbers(mesh.cell_measure.size(), cells);
    const auto new_face = new_numbers(mesh.face_measure.size(), faces);
    const auto new_vertex = new_numbers(mesh.vertices.size(), vertices);
    Mesh<Dim> part;
    set_cells(mesh, cells, vertices, new_face, new_vertex, part);
    part.cell_body = chosen_values(mesh.cell_body, cells);
    set_faces(mesh, faces, new_cell, new_vertex, part);
    part.body_names = mesh.body_names;
    for (const BoundaryGroup& group : mesh.groups) {
        BoundaryGroup& kept = part.groups.emplace_back(group.name);
        for (const std::int32_t f : group.faces)
            if (new_face[static_cast<std::size_t>(f)] != not_chosen)
                kept.faces.push_back(new_face[static_cast<std::size_t>(f)]);
    }
    return part;
}

template Mesh<2> mesh_of_cells(const Mesh<2>&, const std::vector<std::int32_t>&);
template Mesh<3> mesh_of_cells(const Mesh<3>&, const std::vector<std::int32_t>&);

}  // namespace abut::mesh
