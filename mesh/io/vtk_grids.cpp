#include "abut/mesh/io/vtk_grids.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <utility>

#include "abut/base/sort_unique.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/io/vtk_input.hpp"

namespace abut::mesh {
namespace {

std::uint8_t vtk_type(CellShape shape) {
    constexpr std::array<VtkCell, n_cell_shapes> types = {vtk_triangle,   vtk_quad,  vtk_tetra,
                                                          vtk_hexahedron, vtk_wedge, vtk_pyramid};
    return types[static_cast<std::size_t>(shape)];
}

/// VTK's documented wedge begins with the triangle that is counter-clockwise from outside: our second one.
std::size_t vtk_place(CellShape shape, std::size_t i) { return shape == CellShape::prism ? (i + 3) % 6 : i; }

template <int Dim>
std::vector<Vector<Dim>> points_of(const Mesh<Dim>& mesh, std::span<const std::int32_t> vertices) {
    std::vector<Vector<Dim>> points;
    for (const std::int32_t vertex : vertices) points.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
    return points;
}

/// "body: left" for each body, its number in the array "body".
template <int Dim>
std::string numbers_of_bodies(const Mesh<Dim>& mesh) {
    std::string tags;
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body)
        tags += field_number(body_prefix + mesh.body_names[static_cast<std::size_t>(body)], body);
    return tags;
}

/// Flag per boundary face: 1 for those in the group, else 0.
template <int Dim>
std::vector<std::uint8_t> is_in_group(const Mesh<Dim>& mesh, const BoundaryGroup& group,
                                      std::span<const std::int32_t> boundary) {
    std::vector<std::uint8_t> is_in;
    for (const std::int32_t index : boundary)
        is_in.push_back(std::ranges::binary_search(group.faces, mesh.boundary_faces[static_cast<std::size_t>(index)]) ? 1
                                                                                                                      : 0);
    return is_in;
}

/// The number of each vertex of a mesh among these.
std::vector<std::int64_t> numbers_among(std::size_t n, std::span<const std::int32_t> vertices) {
    std::vector<std::int64_t> numbers(n, -1);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        numbers[static_cast<std::size_t>(vertices[i])] = static_cast<std::int64_t>(i);
    return numbers;
}

template <int Dim>
std::int32_t body_of_face(const Mesh<Dim>& mesh, std::int32_t face) {
    return mesh.cell_body[static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(face)][0])];
}

/// Cells of an unstructured grid before they are packed.
struct GridCells {
    std::vector<std::int64_t> corners, ends;
    std::vector<std::uint8_t> types;
    std::vector<std::int32_t> bodies;

    void end(std::uint8_t type, std::int32_t body) {
        ends.push_back(std::ssize(corners));
        types.push_back(type);
        bodies.push_back(body);
    }
};

template <int Dim>
GridCells cells_among(const Mesh<Dim>& mesh, std::span<const std::int32_t> cells, std::span<const std::int32_t> vertices) {
    const std::vector<std::int64_t> number = numbers_among(mesh.vertices.size(), vertices);
    GridCells made;
    for (const std::int32_t cell : cells) {
        const CellShape shape = mesh.cell_shape[static_cast<std::size_t>(cell)];
        const auto of_cell = mesh.cell_vertices[cell];
        for (std::size_t i = 0; i < of_cell.size(); ++i)
            made.corners.push_back(number[static_cast<std::size_t>(of_cell[vtk_place(shape, i)])]);
        made.end(vtk_type(shape), mesh.cell_body[static_cast<std::size_t>(cell)]);
    }
    return made;
}

template <int Dim>
OutputGrid packed(const Mesh<Dim>& mesh, const GridCells& cells, std::span<const std::int32_t> vertices) {
    auto grid = output_grid<Dim>("UnstructuredGrid", "Cells", points_of(mesh, vertices), cells.corners, cells.ends);
    grid.cells.push_back(output_array("types", cells.types));
    grid.cell_data.push_back(output_array("body", cells.bodies));
    grid.field_data = numbers_of_bodies(mesh);
    return grid;
}

/// The boundary faces that are in groups.
template <int Dim>
std::vector<std::int32_t> faces_in_groups(const Mesh<Dim>& mesh) {
    std::vector<std::int32_t> faces;
    for (const BoundaryGroup& group : mesh.groups) faces.insert(faces.end(), group.faces.begin(), group.faces.end());
    sort_unique(faces);
    return faces;
}

}  // namespace

std::string group_array(const std::string& group) { return group_prefix + group; }

std::vector<std::int32_t> all_of(std::size_t n) {
    std::vector<std::int32_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    return all;
}

template <int Dim>
std::vector<std::int32_t> surface_vertices(const Mesh<Dim>& mesh, std::span<const std::int32_t> boundary) {
    std::vector<char> seen(mesh.vertices.size(), 0);
    std::vector<std::int32_t> vertices;
    for (const std::int32_t face : boundary)
        for (const std::int32_t vertex : mesh.face_vertices[mesh.boundary_faces[static_cast<std::size_t>(face)]])
            if (!std::exchange(seen[static_cast<std::size_t>(vertex)], char{1})) vertices.push_back(vertex);
    return vertices;
}

template <int Dim>
OutputGrid grid_of_cells(const Mesh<Dim>& mesh, std::span<const std::int32_t> cells,
                         std::span<const std::int32_t> vertices) {
    return packed(mesh, cells_among(mesh, cells, vertices), vertices);
}

template <int Dim>
OutputGrid grid_with_groups(const Mesh<Dim>& mesh) {
    const std::vector<std::int32_t> vertices = all_of(mesh.vertices.size());
    const auto n_cells = static_cast<std::size_t>(mesh.n_cells());
    GridCells cells = cells_among(mesh, all_of(n_cells), vertices);
    const std::vector<std::int32_t> faces = faces_in_groups(mesh);
    for (const std::int32_t face : faces) {
        const auto of_face = mesh.face_vertices[face];
        cells.corners.insert(cells.corners.end(), of_face.begin(), of_face.end());
        cells.end(of_face.size() == 2 ? vtk_line : of_face.size() == 3 ? vtk_triangle : vtk_quad, body_of_face(mesh, face));
    }
    OutputGrid grid = packed(mesh, cells, vertices);
    for (const BoundaryGroup& group : mesh.groups) {
        std::vector<std::uint8_t> is_in(n_cells, 0);
        for (const std::int32_t face : faces) is_in.push_back(std::ranges::binary_search(group.faces, face) ? 1 : 0);
        grid.cell_data.push_back(output_array(group_array(group.name), is_in));
    }
    return grid;
}

template <int Dim>
OutputGrid grid_of_surface(const Mesh<Dim>& mesh, std::span<const std::int32_t> boundary,
                           std::span<const std::int32_t> vertices) {
    const std::vector<std::int64_t> number = numbers_among(mesh.vertices.size(), vertices);
    std::vector<std::int64_t> corners, ends;
    std::vector<std::int32_t> bodies;
    for (const std::int32_t index : boundary) {
        const std::int32_t face = mesh.boundary_faces[static_cast<std::size_t>(index)];
        for (const std::int32_t vertex : mesh.face_vertices[face])
            corners.push_back(number[static_cast<std::size_t>(vertex)]);
        ends.push_back(std::ssize(corners));
        bodies.push_back(body_of_face(mesh, face));
    }
    auto grid = output_grid<Dim>("PolyData", Dim == 2 ? "Lines" : "Polys", points_of(mesh, vertices), corners, ends);
    grid.cell_data.push_back(output_array("body", bodies));
    for (const BoundaryGroup& group : mesh.groups)
        grid.cell_data.push_back(output_array(group_array(group.name), is_in_group(mesh, group, boundary)));
    grid.field_data = numbers_of_bodies(mesh);
    return grid;
}

#define ABUT_INSTANTIATE(Dim)                                                                                               \
    template OutputGrid grid_with_groups<Dim>(const Mesh<Dim>&);                                                            \
    template std::vector<std::int32_t> surface_vertices<Dim>(const Mesh<Dim>&, std::span<const std::int32_t>);              \
    template OutputGrid grid_of_cells<Dim>(const Mesh<Dim>&, std::span<const std::int32_t>, std::span<const std::int32_t>); \
    template OutputGrid grid_of_surface<Dim>(const Mesh<Dim>&, std::span<const std::int32_t>, std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::mesh
