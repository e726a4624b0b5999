#include "abut/mesh/io/vtk_grids.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <array>
#include <numeric>
#include <utility>

#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/io/vtk_output.hpp"

namespace abut::mesh {
namespace {

int vtk_type(CellShape shape) {
    constexpr std::array<int, n_cell_shapes> types = {VTK_TRIANGLE,   VTK_QUAD,  VTK_TETRA,
                                                      VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID};
    return types[static_cast<std::size_t>(shape)];
}

/// VTK's documented wedge begins with the triangle that is counter-clockwise from outside: our second one.
std::size_t vtk_place(CellShape shape, std::size_t i) { return shape == CellShape::prism ? (i + 3) % 6 : i; }

template <int Dim>
vtkSmartPointer<vtkPoints> points_of(const Mesh<Dim>& mesh, std::span<const std::int32_t> vertices) {
    auto points = vtkSmartPointer<vtkPoints>::New();
    points->SetDataTypeToDouble();
    for (const std::int32_t vertex : vertices) {
        std::array<double, 3> x{};
        fill(x.data(), mesh.vertices[static_cast<std::size_t>(vertex)]);
        points->InsertNextPoint(x.data());
    }
    return points;
}

/// The number of each vertex of a mesh among these.
std::vector<vtkIdType> numbers_among(std::size_t n, std::span<const std::int32_t> vertices) {
    std::vector<vtkIdType> numbers(n, -1);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        numbers[static_cast<std::size_t>(vertices[i])] = static_cast<vtkIdType>(i);
    return numbers;
}

}  // namespace

std::vector<std::int32_t> all_of(std::size_t n) {
    std::vector<std::int32_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    return all;
}

template <int Dim>
std::vector<std::int32_t> vertices_of_cells(const Mesh<Dim>& mesh, std::span<const std::int32_t> cells) {
    std::vector<char> used(mesh.vertices.size(), 0);
    for (const std::int32_t cell : cells)
        for (const std::int32_t vertex : mesh.cell_vertices[cell]) used[static_cast<std::size_t>(vertex)] = 1;
    std::vector<std::int32_t> vertices;
    for (std::size_t vertex = 0; vertex < used.size(); ++vertex)
        if (used[vertex] != 0) vertices.push_back(static_cast<std::int32_t>(vertex));
    return vertices;
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

void add_numbers(vtkDataSet& grid, const char* name, std::span<const std::int32_t> numbers) {
    vtkNew<vtkIntArray> array;
    array->SetName(name);
    array->SetNumberOfTuples(static_cast<vtkIdType>(numbers.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), numbers[i]);
    grid.GetCellData()->AddArray(array);
}

template <int Dim>
vtkSmartPointer<vtkUnstructuredGrid> grid_of_cells(const Mesh<Dim>& mesh, std::span<const std::int32_t> cells,
                                                   std::span<const std::int32_t> vertices) {
    const std::vector<vtkIdType> number = numbers_among(mesh.vertices.size(), vertices);
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points_of(mesh, vertices));
    grid->Allocate(static_cast<vtkIdType>(cells.size()));
    std::array<vtkIdType, max_cell_vertices> ids{};
    std::vector<std::int32_t> bodies;
    for (const std::int32_t cell : cells) {
        const CellShape shape = mesh.cell_shape[static_cast<std::size_t>(cell)];
        const auto corners = mesh.cell_vertices[cell];
        for (std::size_t i = 0; i < corners.size(); ++i)
            ids[i] = number[static_cast<std::size_t>(corners[vtk_place(shape, i)])];
        grid->InsertNextCell(vtk_type(shape), static_cast<vtkIdType>(corners.size()), ids.data());
        bodies.push_back(mesh.cell_body[static_cast<std::size_t>(cell)]);
    }
    add_numbers(*grid, "body", bodies);
    return grid;
}

template <int Dim>
vtkSmartPointer<vtkPolyData> grid_of_surface(const Mesh<Dim>& mesh, std::span<const std::int32_t> boundary,
                                             std::span<const std::int32_t> vertices) {
    const std::vector<vtkIdType> number = numbers_among(mesh.vertices.size(), vertices);
    vtkNew<vtkCellArray> faces;
    std::vector<std::int32_t> bodies;
    for (const std::int32_t index : boundary) {
        const std::int32_t face = mesh.boundary_faces[static_cast<std::size_t>(index)];
        const auto corners = mesh.face_vertices[face];
        faces->InsertNextCell(static_cast<int>(corners.size()));
        for (const std::int32_t vertex : corners) faces->InsertCellPoint(number[static_cast<std::size_t>(vertex)]);
        bodies.push_back(mesh.cell_body[static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(face)][0])]);
    }
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(points_of(mesh, vertices));
    if (Dim == 2)
        surface->SetLines(faces);
    else
        surface->SetPolys(faces);
    add_numbers(*surface, "body", bodies);
    return surface;
}

#define ABUT_INSTANTIATE(Dim)                                                                                         \
    template std::vector<std::int32_t> vertices_of_cells<Dim>(const Mesh<Dim>&, std::span<const std::int32_t>);       \
    template std::vector<std::int32_t> surface_vertices<Dim>(const Mesh<Dim>&, std::span<const std::int32_t>);        \
    template vtkSmartPointer<vtkUnstructuredGrid> grid_of_cells<Dim>(const Mesh<Dim>&, std::span<const std::int32_t>, \
                                                                     std::span<const std::int32_t>);                  \
    template vtkSmartPointer<vtkPolyData> grid_of_surface<Dim>(const Mesh<Dim>&, std::span<const std::int32_t>,       \
                                                               std::span<const std::int32_t>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::mesh
