#include "abut/mesh/checks.hpp"

#include <algorithm>
#include <cmath>

#include "abut/base/messages.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/measures.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

constexpr double smallest_relative_measure = 1e-12;

template <class Container>
std::string text(const Container& container, std::int32_t i) {
    return std::to_string(container[static_cast<std::size_t>(i)]);
}

template <int Dim>
void check_sizes(const CellSoup<Dim>& soup) {
    const auto n = soup.cell_shape.size();
    if (n == 0)
        throw MeshError(soup.name + ": the mesh is empty: it has 0 cells of dimension " + std::to_string(Dim) +
                        ", at least 1 is needed. Check the dimension of the mesh and that its volume was meshed.");
    if (static_cast<std::size_t>(soup.cell_vertices.size()) != n || soup.cell_body.size() != n ||
        soup.cell_label.size() != n)
        throw MeshError(soup.name + ": " + std::to_string(n) + " cell shapes, but " +
                        std::to_string(soup.cell_vertices.size()) + " rows of vertices, " +
                        std::to_string(soup.cell_body.size()) + " bodies and " + std::to_string(soup.cell_label.size()) +
                        " labels. Give one of each for every cell.");
    if (soup.vertex_label.size() != soup.vertices.size())
        throw MeshError(soup.name + ": " + std::to_string(soup.vertices.size()) + " vertices but " +
                        std::to_string(soup.vertex_label.size()) + " vertex labels. Give one for every vertex, or none.");
}

template <int Dim>
void check_coordinates(const CellSoup<Dim>& soup) {
    for (std::size_t vertex = 0; vertex < soup.vertices.size(); ++vertex)
        for (int i = 0; i < Dim; ++i)
            if (!std::isfinite(soup.vertices[vertex][i]))
                throw MeshError(soup.name + ": vertex " + std::to_string(soup.vertex_label[vertex]) + " has the " +
                                "xyz"[i] + " coordinate " + number(soup.vertices[vertex][i]) +
                                ", a finite number is needed. Mesh the part again.");
}

template <int Dim>
void check_indices(const CellSoup<Dim>& soup, const char* kind, std::int64_t owner, std::span<const std::int32_t> vertices) {
    for (const std::int32_t vertex : vertices)
        if (vertex < 0 || static_cast<std::size_t>(vertex) >= soup.vertices.size())
            throw MeshError(soup.name + ": " + kind + " " + std::to_string(owner) + " has the vertex " +
                            std::to_string(vertex) + ", 0 to " +
                            std::to_string(static_cast<std::ptrdiff_t>(soup.vertices.size()) - 1) +
                            " are allowed. Number vertices from 0, without gaps.");
}

template <int Dim>
[[noreturn]] void throw_about_cell(const CellSoup<Dim>& soup, std::int32_t cell, const std::string& what) {
    throw MeshError(soup.name + ": cell " + text(soup.cell_label, cell) + " " + what);
}

template <int Dim>
void check_no_vertex_twice(const CellSoup<Dim>& soup, std::int32_t cell) {
    const auto vertices = soup.cell_vertices[cell];
    for (std::size_t i = 1; i < vertices.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (vertices[i] == vertices[k])
                throw_about_cell(
                    soup, cell,
                    "has the vertex " + text(soup.vertex_label, vertices[i]) +
                        " twice. Write it as the shape it has collapsed to (a prism, a pyramid, a tetrahedron).");
}

template <int Dim>
void check_cell(const CellSoup<Dim>& soup, std::int32_t cell) {
    const CellShape shape = soup.cell_shape[static_cast<std::size_t>(cell)];
    if (static_cast<int>(shape) >= n_cell_shapes || dimension(shape) != Dim)
        throw_about_cell(
            soup, cell,
            "is no cell of dimension " + std::to_string(Dim) + ". Leave it out, or build the mesh in its own dimension.");
    const auto vertices = soup.cell_vertices[cell];
    if (static_cast<int>(vertices.size()) != n_vertices(shape))
        throw_about_cell(soup, cell,
                         "has " + std::to_string(vertices.size()) + " vertices, a " + std::string(name(shape)) + " has " +
                             std::to_string(n_vertices(shape)) + ". Give its corners only (elements of first order).");
    check_indices(soup, "cell", soup.cell_label[static_cast<std::size_t>(cell)], vertices);
    check_no_vertex_twice(soup, cell);
    const std::int32_t body = soup.cell_body[static_cast<std::size_t>(cell)];
    if (body < 0 || static_cast<std::size_t>(body) >= soup.body_names.size())
        throw_about_cell(soup, cell,
                         "belongs to body " + std::to_string(body) + ", but there are " +
                             std::to_string(soup.body_names.size()) + " body names. Name every body.");
}

template <int Dim>
void check_bodies(const CellSoup<Dim>& soup) {
    std::vector<std::int32_t> n_cells(soup.body_names.size(), 0);
    for (const std::int32_t body : soup.cell_body) ++n_cells[static_cast<std::size_t>(body)];
    for (std::size_t body = 0; body < n_cells.size(); ++body)
        if (n_cells[body] == 0)
            throw MeshError(soup.name + ": body '" + soup.body_names[body] + "' has 0 cells of dimension " +
                            std::to_string(Dim) +
                            ", at least 1 is needed. Mesh it, or leave it out (in Gmsh: its physical group).");
    check_distinct(soup.name, "bodies", soup.body_names);
}

template <int Dim>
void check_named_faces(const CellSoup<Dim>& soup) {
    for (std::size_t i = 0; i < soup.named_faces.size(); ++i) {
        const auto& face = soup.named_faces[i];
        if (face.group < 0 || static_cast<std::size_t>(face.group) >= soup.group_names.size())
            throw MeshError(soup.name + ": named face " + std::to_string(i) + " belongs to group " +
                            std::to_string(face.group) + ", but there are " + std::to_string(soup.group_names.size()) +
                            " group names. Name every group.");
        check_indices(soup, "named face", static_cast<std::int64_t>(i), face.vertices);
    }
}

template <int Dim>
std::string face_of(const Mesh<Dim>& mesh, std::int32_t face) {
    const auto cells = mesh.face_cells[static_cast<std::size_t>(face)];
    return mesh.name + ": face " + vertex_list(mesh.face_vertices[face], mesh.vertex_label) + " of " +
           (cells[1] < 0 ? "cell " : "cells ") + text(mesh.cell_label, cells[0]) +
           (cells[1] < 0 ? std::string() : std::string("|") + text(mesh.cell_label, cells[1]));
}

template <int Dim>
void check_face_is_convex(const Mesh<Dim>& mesh, std::int32_t face) {
    const double size = face_size<Dim>(mesh.face_measure[static_cast<std::size_t>(face)]);
    const auto corners = face_corners<Dim>(mesh.vertices, mesh.face_vertices[face]);
    if (corners.count > Dim && !geometry::is_convex<Dim>(corners.view(), 1e-10 * size))
        throw MeshError(face_of(mesh, face) + " is not convex. Give its vertices in order around it, or cut its cells.");
}

template <int Dim>
void check_face_measure(const Mesh<Dim>& mesh, std::int32_t face) {
    const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(face)][0];
    const double limit =
        smallest_relative_measure * std::pow(diameter<Dim>(mesh.vertices, mesh.cell_vertices[cell]), Dim - 1);
    const double measure = mesh.face_measure[static_cast<std::size_t>(face)];
    if (measure > limit) return;
    throw MeshError(face_of(mesh, face) + " is degenerate: its measure is " + number(measure) + " m^" +
                    std::to_string(Dim - 1) + ", more than " + number(limit) +
                    " is needed. Merge coinciding vertices and remove the collapsed cell.");
}

template <int Dim>
void check_centroid_inside(const Mesh<Dim>& mesh, std::int32_t cell) {
    const auto c = static_cast<std::size_t>(cell);
    for (const std::int32_t face : mesh.cell_faces[cell]) {
        const auto f = static_cast<std::size_t>(face);
        const double outward = mesh.face_cells[f][0] == cell ? 1.0 : -1.0;
        const double distance = outward * mesh.face_normal[f].dot(mesh.face_centroid[f] - mesh.cell_centroid[c]);
        if (distance > 0.0) continue;
        throw MeshError(mesh.name + ": cell " + text(mesh.cell_label, cell) +
                        " is folded or far from convex: its centroid lies " + number(-distance) + " m outside its face " +
                        vertex_list(mesh.face_vertices[face], mesh.vertex_label) +
                        ", it must lie inside all of them. Cut the cell, or give its vertices in the order of its shape.");
    }
}

}  // namespace

std::string vertex_list(std::span<const std::int32_t> vertices, const std::vector<std::int64_t>& labels) {
    std::string list = "(";
    for (const std::int32_t vertex : vertices) list += std::string(list.size() > 1 ? ", " : "") + text(labels, vertex);
    return list + ")";
}

void check_distinct(const std::string& mesh_name, const std::string& what, std::vector<std::string> names) {
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
        throw MeshError(mesh_name + ": " + std::to_string(std::count(twice, names.end(), *twice)) + " " + what +
                        " are called '" + *twice + "', each needs a name of its own. Rename them, or make them one.");
}

template <int Dim>
void check_soup(const CellSoup<Dim>& soup) {
    check_sizes(soup);
    check_coordinates(soup);
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell) check_cell(soup, cell);
    check_bodies(soup);
    check_distinct(soup.name, "boundary groups", soup.group_names);
    check_named_faces(soup);
}

template <int Dim>
void check_bodies_apart(const CellSoup<Dim>& soup) {
    std::vector<std::int32_t> first_cell(soup.vertices.size(), -1);
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell)
        for (const std::int32_t vertex : soup.cell_vertices[cell]) {
            auto& first = first_cell[static_cast<std::size_t>(vertex)];
            if (first < 0) first = cell;
            const auto body = static_cast<std::size_t>(soup.cell_body[static_cast<std::size_t>(cell)]);
            const auto other = static_cast<std::size_t>(soup.cell_body[static_cast<std::size_t>(first)]);
            if (body != other)
                throw MeshError(soup.name + ": bodies '" + soup.body_names[other] + "' and '" + soup.body_names[body] +
                                "' share vertex " + text(soup.vertex_label, vertex) + " (cells " +
                                text(soup.cell_label, first) + "|" + text(soup.cell_label, cell) +
                                "). Give each body its own vertices on the interface, let them be separated as the "
                                "file is read, or make them one body.");
        }
}

template <int Dim>
void check_cells(const CellSoup<Dim>& soup, std::span<const double> cell_measure) {
    for (std::size_t c = 0; c < cell_measure.size(); ++c) {
        const auto cell = static_cast<std::int32_t>(c);
        const double limit =
            smallest_relative_measure * std::pow(diameter<Dim>(soup.vertices, soup.cell_vertices[cell]), Dim);
        if (cell_measure[c] > limit) continue;
        throw MeshError(soup.name + ": cell " + text(soup.cell_label, cell) + " (" + std::string(name(soup.cell_shape[c])) +
                        ") is flat: its measure is " + number(cell_measure[c]) + " m^" + std::to_string(Dim) +
                        ", more than " + number(limit) + " is needed. Remove it or mesh the part again.");
    }
}

template <int Dim>
void check_faces(const Mesh<Dim>& mesh) {
    for (std::int32_t face = 0; face < mesh.n_faces(); ++face) {
        check_face_measure(mesh, face);
        check_face_is_convex(mesh, face);
    }
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) check_centroid_inside(mesh, cell);
}

template void check_soup<2>(const CellSoup<2>&);
template void check_soup<3>(const CellSoup<3>&);
template void check_bodies_apart<2>(const CellSoup<2>&);
template void check_bodies_apart<3>(const CellSoup<3>&);
template void check_cells<2>(const CellSoup<2>&, std::span<const double>);
template void check_cells<3>(const CellSoup<3>&, std::span<const double>);
template void check_faces<2>(const Mesh<2>&);
template void check_faces<3>(const Mesh<3>&);

}  // namespace abut::mesh
