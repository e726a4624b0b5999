#include "abut/mesh/extract.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/error.hpp"

namespace abut::mesh {
namespace {

constexpr std::int32_t none = -1;

/// The rows that are chosen, with their values by new numbers.
Rows chosen_rows(const Rows& rows, const std::vector<std::int32_t>& chosen, const std::vector<std::int32_t>& new_number) {
    Rows result;
    std::vector<std::int32_t> row;
    for (const std::int32_t i : chosen) {
        row.clear();
        for (const std::int32_t value : rows[i]) row.push_back(new_number[static_cast<std::size_t>(value)]);
        result.append(row);
    }
    return result;
}

template <class Value>
std::vector<Value> chosen_values(const std::vector<Value>& values, const std::vector<std::int32_t>& chosen) {
    std::vector<Value> result;
    for (const std::int32_t i : chosen) result.push_back(values[static_cast<std::size_t>(i)]);
    return result;
}

/// Numbers of the kept in the old order; `none` for the others.
std::vector<std::int32_t> numbered(std::size_t n, const std::vector<std::int32_t>& kept) {
    std::vector<std::int32_t> number(n, none);
    for (std::size_t i = 0; i < kept.size(); ++i) number[static_cast<std::size_t>(kept[i])] = static_cast<std::int32_t>(i);
    return number;
}

}  // namespace

template <int Dim>
Mesh<Dim> extract_bodies(const Mesh<Dim>& mesh, std::span<const std::int32_t> bodies) {
    std::vector<std::int32_t> new_body(static_cast<std::size_t>(mesh.n_bodies()), none);
    std::int32_t last = none, n = 0;
    for (const std::int32_t body : bodies) {
        if (body <= last || body >= mesh.n_bodies())
            throw BadInput(mesh.name + ": body " + std::to_string(body) + " is asked for after " + std::to_string(last) +
                           "; give bodies in increasing order, from 0 to " + std::to_string(mesh.n_bodies() - 1) + ".");
        new_body[static_cast<std::size_t>(body)] = n++;
        last = body;
    }

    std::vector<std::int32_t> cells, faces, vertices;
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c)
        if (new_body[mesh.cell_body[c]] != none) cells.push_back(c);
    for (std::int32_t f = 0; f < mesh.n_faces(); ++f)
        if (new_body[mesh.cell_body[mesh.face_cells[f][0]]] != none) faces.push_back(f);
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const std::int32_t c : cells)
        for (const std::int32_t v : mesh.cell_vertices[c]) used[static_cast<std::size_t>(v)] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) vertices.push_back(static_cast<std::int32_t>(v));
    const auto new_cell = numbered(mesh.cell_measure.size(), cells), new_face = numbered(mesh.face_measure.size(), faces);
    const auto new_vertex = numbered(mesh.vertices.size(), vertices);

    Mesh<Dim> part;
    part.name = mesh.name;
    part.vertices = chosen_values(mesh.vertices, vertices);
    part.vertex_label = chosen_values(mesh.vertex_label, vertices);
    part.cell_shape = chosen_values(mesh.cell_shape, cells);
    part.cell_vertices = chosen_rows(mesh.cell_vertices, cells, new_vertex);
    part.cell_faces = chosen_rows(mesh.cell_faces, cells, new_face);
    for (const std::int32_t c : cells) part.cell_body.push_back(new_body[mesh.cell_body[c]]);
    part.cell_measure = chosen_values(mesh.cell_measure, cells);
    part.cell_centroid = chosen_values(mesh.cell_centroid, cells);
    part.cell_label = chosen_values(mesh.cell_label, cells);
    part.face_vertices = chosen_rows(mesh.face_vertices, faces, new_vertex);
    for (const std::int32_t f : faces) {
        const auto [first, second] = mesh.face_cells[f];
        part.face_cells.push_back({new_cell[first], second < 0 ? none : new_cell[second]});
    }
    part.face_measure = chosen_values(mesh.face_measure, faces);
    part.face_centroid = chosen_values(mesh.face_centroid, faces);
    part.face_normal = chosen_values(mesh.face_normal, faces);
    for (const std::int32_t f : mesh.boundary_faces)
        if (new_face[f] != none) part.boundary_faces.push_back(new_face[f]);
    for (const std::int32_t body : bodies) part.body_names.push_back(mesh.body_names[body]);
    for (const BoundaryGroup& group : mesh.groups) {
        BoundaryGroup kept{group.name, {}};
        for (const std::int32_t f : group.faces)
            if (new_face[f] != none) kept.faces.push_back(new_face[f]);
        if (!kept.faces.empty()) part.groups.push_back(std::move(kept));
    }
    part.report = mesh.report;
    return part;
}

template Mesh<2> extract_bodies<2>(const Mesh<2>&, std::span<const std::int32_t>);
template Mesh<3> extract_bodies<3>(const Mesh<3>&, std::span<const std::int32_t>);

}  // namespace abut::mesh
