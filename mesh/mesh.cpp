#include "abut/mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "abut/base/disjoint_sets.hpp"
#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/box.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/checks.hpp"
#include "abut/mesh/combine.hpp"
#include "abut/mesh/measures.hpp"
#include "abut/mesh/own_vertices.hpp"
#include "abut/mesh/quality.hpp"
#include "abut/mesh/reorder.hpp"
#include "abut/mesh/split.hpp"
#include "abut/mesh/topology.hpp"

namespace abut::mesh {
namespace {

void fill_labels(std::vector<std::int64_t>& labels, std::size_t n) {
    if (!labels.empty()) return;
    labels.resize(n);
    std::iota(labels.begin(), labels.end(), std::int64_t{0});
}

template <int Dim>
[[noreturn]] void throw_not_boundary(const CellSoup<Dim>& soup, const typename CellSoup<Dim>::NamedFace& face) {
    const auto lost = std::find(face.vertices.begin(), face.vertices.end(), -1) != face.vertices.end();
    const auto which = lost ? std::string("with a vertex that no cell has") : vertex_list(face.vertices, soup.vertex_label);
    throw MeshError(soup.name + ": face " + which + " of group '" + soup.group_names[static_cast<std::size_t>(face.group)] +
                    "' is not a boundary face of any cell. Name faces of the outer surface only, with the vertices of the "
                    "cells behind them.");
}

template <int Dim>
std::vector<BoundaryGroup> boundary_groups(const CellSoup<Dim>& soup, const Faces& faces) {
    std::vector<BoundaryGroup> groups;
    for (const std::string& name : soup.group_names) groups.push_back({name, {}});
    if (soup.named_faces.empty()) return groups;
    const BoundaryFaceFinder finder(faces.face_vertices, faces.face_cells);
    for (const auto& named : soup.named_faces) {
        const std::int32_t face = finder.find(named.vertices);
        if (face < 0) throw_not_boundary(soup, named);
        groups[static_cast<std::size_t>(named.group)].faces.push_back(face);
    }
    for (BoundaryGroup& group : groups) {
        sort_unique(group.faces);
    }
    return groups;
}

std::vector<std::int32_t> faces_of_one_cell(const std::vector<std::array<std::int32_t, 2>>& face_cells) {
    std::vector<std::int32_t> faces;
    for (std::size_t face = 0; face < face_cells.size(); ++face)
        if (face_cells[face][1] < 0) faces.push_back(static_cast<std::int32_t>(face));
    return faces;
}

/// The order of a cell's vertices that makes its mirror image: the way round in the plane, the base seen from the other
/// side in space.
std::span<const std::int8_t> mirrored(CellShape shape) {
    static constexpr std::array<std::int8_t, 3> triangle = {0, 2, 1};
    static constexpr std::array<std::int8_t, 4> quadrangle = {0, 3, 2, 1}, tetrahedron = {0, 2, 1, 3};
    static constexpr std::array<std::int8_t, 8> hexahedron = {4, 5, 6, 7, 0, 1, 2, 3};
    static constexpr std::array<std::int8_t, 6> prism = {3, 4, 5, 0, 1, 2};
    static constexpr std::array<std::int8_t, 5> pyramid = {0, 3, 2, 1, 4};
    switch (shape) {
        case CellShape::triangle:
            return triangle;
        case CellShape::quadrangle:
            return quadrangle;
        case CellShape::tetrahedron:
            return tetrahedron;
        case CellShape::hexahedron:
            return hexahedron;
        case CellShape::prism:
            return prism;
        case CellShape::pyramid:
            break;
    }
    return pyramid;
}

/// Turns the cells of negative measure and measures them again; returns their number.
template <int Dim>
std::int32_t turn_cells_inside_out(CellSoup<Dim>& soup, CellMeasures<Dim>& cells) {
    std::int32_t count = 0;
    std::array<std::int32_t, max_cell_vertices> given{};
    for (std::int32_t cell = 0; cell < soup.cell_vertices.size(); ++cell) {
        const auto c = static_cast<std::size_t>(cell);
        if (!(cells.measure[c] < 0.0)) continue;
        const auto order = mirrored(soup.cell_shape[c]);
        std::ranges::copy(soup.cell_vertices[cell], given.begin());
        for (std::size_t i = 0; i < order.size(); ++i)
            soup.cell_vertices.values[static_cast<std::size_t>(soup.cell_vertices.offsets[c]) + i] =
                given[static_cast<std::size_t>(order[i])];
        measure_cell(soup, cell, cells.measure[c], cells.centroid[c]);
        ++count;
    }
    return count;
}

/// A mesh out of a soup that is checked and in its final order.
template <int Dim>
Mesh<Dim> assemble(CellSoup<Dim> soup, Faces faces, CellMeasures<Dim> cells) {
    Mesh<Dim> mesh;
    mesh.groups = boundary_groups(soup, faces);
    mesh.name = std::move(soup.name);
    mesh.vertices = std::move(soup.vertices);
    mesh.cell_shape = std::move(soup.cell_shape);
    mesh.cell_vertices = std::move(soup.cell_vertices);
    mesh.cell_body = std::move(soup.cell_body);
    mesh.body_names = std::move(soup.body_names);
    mesh.cell_label = std::move(soup.cell_label);
    mesh.vertex_label = std::move(soup.vertex_label);
    mesh.cell_measure = std::move(cells.measure);
    mesh.cell_centroid = std::move(cells.centroid);
    mesh.cell_faces = std::move(faces.cell_faces);
    mesh.face_vertices = std::move(faces.face_vertices);
    mesh.face_cells = std::move(faces.face_cells);
    mesh.boundary_faces = faces_of_one_cell(mesh.face_cells);
    measure_faces(mesh);
    return mesh;
}

template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

void append_shifted(std::vector<std::int32_t>& to, const std::vector<std::int32_t>& from, std::int32_t shift) {
    for (const std::int32_t value : from) to.push_back(value + shift);
}

void append_shifted(Rows& to, const Rows& from, std::int32_t shift) {
    const auto start = static_cast<std::int32_t>(to.values.size());
    append_shifted(to.values, from.values, shift);
    for (std::size_t row = 1; row < from.offsets.size(); ++row) to.offsets.push_back(from.offsets[row] + start);
}

/// Everything but names and groups.
template <int Dim>
void append_cells_and_faces(Mesh<Dim>& to, const Mesh<Dim>& from) {
    const std::int32_t cells = to.n_cells(), faces = to.n_faces(), bodies = to.n_bodies();
    append_shifted(to.cell_vertices, from.cell_vertices, static_cast<std::int32_t>(to.vertices.size()));
    append_shifted(to.face_vertices, from.face_vertices, static_cast<std::int32_t>(to.vertices.size()));
    append_shifted(to.cell_faces, from.cell_faces, faces);
    append_shifted(to.cell_body, from.cell_body, bodies);
    append_shifted(to.boundary_faces, from.boundary_faces, faces);
    for (const auto& pair : from.face_cells) to.face_cells.push_back({pair[0] + cells, pair[1] < 0 ? -1 : pair[1] + cells});
    append(to.vertices, from.vertices);
    append(to.cell_shape, from.cell_shape);
    append(to.cell_measure, from.cell_measure);
    append(to.cell_centroid, from.cell_centroid);
    append(to.face_measure, from.face_measure);
    append(to.face_centroid, from.face_centroid);
    append(to.face_normal, from.face_normal);
    append(to.cell_label, from.cell_label);
    append(to.vertex_label, from.vertex_label);
}

/// Makes room for the cells and faces of all meshes: arrays that grow by themselves take up to twice as much.
template <int Dim>
void reserve_all(Mesh<Dim>& result, std::span<const Mesh<Dim>> meshes) {
    const auto reserve = [&](const auto& array_of) {
        std::size_t n = 0;
        for (const Mesh<Dim>& mesh : meshes) n += array_of(mesh).size();
        array_of(result).reserve(n);
    };
    reserve([](auto& mesh) -> auto& { return mesh.vertices; });
    reserve([](auto& mesh) -> auto& { return mesh.vertex_label; });
    reserve([](auto& mesh) -> auto& { return mesh.cell_shape; });
    reserve([](auto& mesh) -> auto& { return mesh.cell_body; });
    reserve([](auto& mesh) -> auto& { return mesh.cell_measure; });
    reserve([](auto& mesh) -> auto& { return mesh.cell_centroid; });
    reserve([](auto& mesh) -> auto& { return mesh.cell_label; });
    reserve([](auto& mesh) -> auto& { return mesh.face_cells; });
    reserve([](auto& mesh) -> auto& { return mesh.face_measure; });
    reserve([](auto& mesh) -> auto& { return mesh.face_centroid; });
    reserve([](auto& mesh) -> auto& { return mesh.face_normal; });
    for (Rows Mesh<Dim>::*rows : {&Mesh<Dim>::cell_vertices, &Mesh<Dim>::cell_faces, &Mesh<Dim>::face_vertices}) {
        reserve([=](auto& mesh) -> auto& { return (mesh.*rows).offsets; });
        reserve([=](auto& mesh) -> auto& { return (mesh.*rows).values; });
    }
}

/// `bodies`: how many there are before those of `from`.
void append_report(BuildReport& to, const BuildReport& from, std::int32_t bodies) {
    to.n_unused_vertices += from.n_unused_vertices;
    to.n_ignored_elements += from.n_ignored_elements;
    to.n_turned_cells += from.n_turned_cells;
    to.n_non_planar_faces += from.n_non_planar_faces;
    to.n_cut_cells += from.n_cut_cells;
    append(to.warnings, from.warnings);
    for (const auto& [a, b] : from.joined_bodies) to.joined_bodies.push_back({a + bodies, b + bodies});
    if (from.worst_planarity <= to.worst_planarity && to.worst_face_cell >= 0) return;
    to.worst_planarity = from.worst_planarity;
    to.worst_face_cell = from.worst_face_cell;
}

/// One prefix a mesh: its name, with "_1", "_2", ... behind it where several have the same name.
template <int Dim>
std::vector<std::string> prefixes(std::span<const Mesh<Dim>> meshes) {
    std::map<std::string, int> total, seen;
    for (const auto& mesh : meshes) ++total[mesh.name];
    std::vector<std::string> result;
    for (const auto& mesh : meshes)
        result.push_back(mesh.name +
                         (total[mesh.name] > 1 ? std::string("_") + std::to_string(++seen[mesh.name]) : std::string()));
    return result;
}

/// names[i] are those of mesh i; those that occur in another mesh too get the prefix of their mesh in front.
void make_unique(std::vector<std::vector<std::string>>& names, const std::vector<std::string>& prefix) {
    std::map<std::string, int> total;
    for (const auto& of_mesh : names)
        for (const std::string& name : of_mesh) ++total[name];
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::string& name : names[i])
            if (total[name] > 1) name = prefix[i] + "." + name;
}

template <int Dim>
void append_names(Mesh<Dim>& result, std::span<const Mesh<Dim>> meshes) {
    std::vector<std::vector<std::string>> bodies, groups;
    for (const auto& mesh : meshes) {
        bodies.push_back(mesh.body_names);
        groups.emplace_back();
        for (const BoundaryGroup& group : mesh.groups) groups.back().push_back(group.name);
    }
    const auto prefix = prefixes(meshes);
    make_unique(bodies, prefix);
    make_unique(groups, prefix);
    std::int32_t faces = 0;
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        append(result.body_names, bodies[i]);
        for (std::size_t k = 0; k < groups[i].size(); ++k) {
            result.groups.push_back({groups[i][k], {}});
            append_shifted(result.groups.back().faces, meshes[i].groups[k].faces, faces);
        }
        faces += meshes[i].n_faces();
    }
}

template <int Dim>
void check_names(const Mesh<Dim>& mesh) {
    std::vector<std::string> groups;
    for (const BoundaryGroup& group : mesh.groups) groups.push_back(group.name);
    check_distinct(mesh.name, "bodies", mesh.body_names);
    check_distinct(mesh.name, "boundary groups", groups);
}

/// A place on a grid, and whose vertex is there.
template <int Dim>
using Place = std::pair<std::array<std::int64_t, Dim>, std::int32_t>;

/// For each body the first of those that it is joined to, itself where it is joined to none.
template <int Dim>
std::vector<std::int32_t> first_of_joined(const Mesh<Dim>& mesh) {
    DisjointSets joined(static_cast<std::size_t>(mesh.n_bodies()));
    for (const auto& [a, b] : mesh.report.joined_bodies) joined.join(a, b);
    std::vector<std::int32_t> first;
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) first.push_back(joined.find(body));
    return first;
}

/// The boundary vertices on a grid of `spacing`, each once for every body or for those that are joined, sorted. The
/// grid starts at no round number: what differs in its last digits comes to one point of it.
template <int Dim>
std::vector<Place<Dim>> places_of_boundary_vertices(const Mesh<Dim>& mesh, double spacing) {
    geometry::Box<Dim> box;
    for (const Vector<Dim>& vertex : mesh.vertices) box.extend(vertex);
    const Vector<Dim> origin = box.lower - Vector<Dim>::Constant(std::numbers::inv_pi * spacing);
    const std::vector<std::int32_t> first = first_of_joined(mesh);
    std::vector<Place<Dim>> places;
    for (const std::int32_t face : mesh.boundary_faces)
        for (const std::int32_t vertex : mesh.face_vertices[face]) {
            Place<Dim> place;
            for (int i = 0; i < Dim; ++i)
                place.first[static_cast<std::size_t>(i)] =
                    std::llround((mesh.vertices[static_cast<std::size_t>(vertex)][i] - origin[i]) / spacing);
            const std::int32_t cell = mesh.face_cells[static_cast<std::size_t>(face)][0];
            place.second = first[static_cast<std::size_t>(mesh.cell_body[static_cast<std::size_t>(cell)])];
            places.push_back(place);
        }
    sort_unique(places);
    return places;
}

template <int Dim>
std::int32_t count_coincident_vertices(const Mesh<Dim>& mesh) {
    if (mesh.n_bodies() < 2) return 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (const std::int32_t face : mesh.boundary_faces)
        smallest = std::min(smallest, face_size<Dim>(mesh.face_measure[static_cast<std::size_t>(face)]));
    const auto places = places_of_boundary_vertices(mesh, 1e-6 * smallest);
    std::int32_t count = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool like_the_one_before = i > 0 && places[i - 1].first == places[i].first;
        const bool like_the_next = i + 1 < places.size() && places[i + 1].first == places[i].first;
        count += like_the_one_before || like_the_next;
    }
    return count;
}

/// `is_done(i)` is called once the whole has all of mesh i.
template <int Dim, class IsDone>
Mesh<Dim> combined(std::span<const Mesh<Dim>> meshes, const IsDone& is_done) {
    Mesh<Dim> result;
    reserve_all(result, meshes);
    append_names(result, meshes);
    std::vector<std::string> names;
    std::swap(names, result.body_names);  // bodies are counted while the meshes come in
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        append_report(result.report, meshes[i].report, result.n_bodies());
        append_cells_and_faces(result, meshes[i]);
        append(result.body_names, meshes[i].body_names);
        result.name += (result.name.empty() ? "" : "+") + meshes[i].name;
        is_done(i);
    }
    result.body_names = std::move(names);
    check_names(result);
    result.report.n_coincident_vertices = count_coincident_vertices(result);
    return result;
}

}  // namespace

template <int Dim>
const BoundaryGroup& Mesh<Dim>::group(const std::string& group_name) const {
    const auto found = std::ranges::find(groups, group_name, &BoundaryGroup::name);
    if (found != groups.end()) return *found;
    std::string known;
    for (const BoundaryGroup& candidate : groups) known += (known.empty() ? "'" : ", '") + candidate.name + "'";
    throw BadInput(name + ": there is no boundary group '" + group_name + "'. The mesh has " +
                   (known.empty() ? "none: name surfaces as physical groups." : known + "."));
}

template <int Dim>
Mesh<Dim> build_mesh(CellSoup<Dim> soup, const MeshOptions& options) {
    if (soup.cell_shape.size() > static_cast<std::size_t>(max_cells))
        throw MeshError(soup.name + ": " + std::to_string(soup.cell_shape.size()) + " cells, at most " +
                        std::to_string(max_cells) + " are allowed. Coarsen the mesh.");
    fill_labels(soup.cell_label, soup.cell_shape.size());
    fill_labels(soup.vertex_label, soup.vertices.size());
    check_soup(soup);

    BuildReport report;
    if (options.shared_vertices == SharedVertices::separate)
        report.joined_bodies = give_own_vertices(soup);
    else
        check_bodies_apart(soup);
    report.n_ignored_elements = soup.n_ignored_elements;
    report.warnings = soup.warnings;
    auto cells = measure_cells(soup);
    report.n_turned_cells = turn_cells_inside_out(soup, cells);
    handle_non_planar_faces(soup, options, report);
    if (report.n_cut_cells > 0) cells = measure_cells(soup);
    check_cells<Dim>(soup, cells.measure);

    const auto order = cell_order<Dim>(soup, cells.centroid, options.reorder);
    report.n_unused_vertices = static_cast<std::int32_t>(soup.vertices.size());
    soup = renumbered<Dim>(soup, order, options.reorder);
    report.n_unused_vertices -= static_cast<std::int32_t>(soup.vertices.size());
    cells = {permuted(cells.measure, order), permuted(cells.centroid, order)};

    Faces faces = find_faces(soup);
    Mesh<Dim> mesh = assemble(std::move(soup), std::move(faces), std::move(cells));
    mesh.report = std::move(report);
    check_faces(mesh);
    mesh.report.n_coincident_vertices = count_coincident_vertices(mesh);
    return mesh;
}

template <int Dim>
Mesh<Dim> combine(std::span<const Mesh<Dim>> meshes) {
    return combined<Dim>(meshes, [](std::size_t) {});
}

template <int Dim>
Mesh<Dim> combine(std::vector<Mesh<Dim>>&& meshes) {
    if (meshes.size() == 1) {
        check_names(meshes.front());
        return std::move(meshes.front());
    }
    return combined<Dim>(meshes, [&](std::size_t i) { meshes[i] = {}; });
}

template struct Mesh<2>;
template struct Mesh<3>;
template Mesh<2> build_mesh<2>(CellSoup<2>, const MeshOptions&);
template Mesh<3> build_mesh<3>(CellSoup<3>, const MeshOptions&);
template Mesh<2> combine<2>(std::span<const Mesh<2>>);
template Mesh<2> combine<2>(std::vector<Mesh<2>>&&);
template Mesh<3> combine<3>(std::span<const Mesh<3>>);
template Mesh<3> combine<3>(std::vector<Mesh<3>>&&);

}  // namespace abut::mesh
