#pragma once
// Private to the sources of this layer: some cells of a mesh as a mesh of their own.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// The new number of what is left out.
inline constexpr std::int32_t not_chosen = -1;

/// The rows that are chosen, with their values by new numbers.
[[nodiscard]] inline Rows chosen_rows(const Rows& rows, const std::vector<std::int32_t>& chosen,
                                      const std::vector<std::int32_t>& new_number) {
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
[[nodiscard]] std::vector<Value> chosen_values(const std::vector<Value>& values, const std::vector<std::int32_t>& chosen) {
    std::vector<Value> result;
    result.reserve(chosen.size());
    for (const std::int32_t i : chosen) result.push_back(values[static_cast<std::size_t>(i)]);
    return result;
}

/// Numbers of the chosen in their order; `not_chosen` for the others.
[[nodiscard]] inline std::vector<std::int32_t> new_numbers(std::size_t n, const std::vector<std::int32_t>& chosen) {
    std::vector<std::int32_t> number(n, not_chosen);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        number[static_cast<std::size_t>(chosen[i])] = static_cast<std::int32_t>(i);
    return number;
}

/// Vertices of some cells, increasing.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> vertices_of(const Mesh<Dim>& mesh, const std::vector<std::int32_t>& cells) {
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const std::int32_t c : cells)
        for (const std::int32_t v : mesh.cell_vertices[c]) used[static_cast<std::size_t>(v)] = true;
    std::vector<std::int32_t> vertices;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) vertices.push_back(static_cast<std::int32_t>(v));
    return vertices;
}

/// Sets name, vertices and cells of `part`, all but their bodies.
template <int Dim>
void set_cells(const Mesh<Dim>& mesh, const std::vector<std::int32_t>& cells, const std::vector<std::int32_t>& vertices,
               const std::vector<std::int32_t>& new_face, const std::vector<std::int32_t>& new_vertex, Mesh<Dim>& part) {
    part.name = mesh.name;
    part.report = mesh.report;
    part.has_lost_cells = mesh.has_lost_cells;
    part.vertices = chosen_values(mesh.vertices, vertices);
    part.vertex_label = chosen_values(mesh.vertex_label, vertices);
    part.cell_shape = chosen_values(mesh.cell_shape, cells);
    part.cell_vertices = chosen_rows(mesh.cell_vertices, cells, new_vertex);
    part.cell_faces = chosen_rows(mesh.cell_faces, cells, new_face);
    part.cell_measure = chosen_values(mesh.cell_measure, cells);
    part.cell_centroid = chosen_values(mesh.cell_centroid, cells);
    part.cell_label = chosen_values(mesh.cell_label, cells);
}

}  // namespace abut::mesh
