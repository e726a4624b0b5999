#include "abut/mesh/io/write_vtu.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>

#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/series_files.hpp"
#include "abut/mesh/io/vtk_output.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

using Path = std::filesystem::path;

int vtk_type(CellShape shape) {
    constexpr std::array<int, n_cell_shapes> types = {VTK_TRIANGLE,   VTK_QUAD,  VTK_TETRA,
                                                      VTK_HEXAHEDRON, VTK_WEDGE, VTK_PYRAMID};
    return types[static_cast<std::size_t>(shape)];
}

/// VTK's documented wedge begins with the triangle that is counter-clockwise from outside: our second one.
std::size_t vtk_place(CellShape shape, std::size_t i) { return shape == CellShape::prism ? (i + 3) % 6 : i; }

template <class Bodies>
void add_bodies(vtkDataSet& grid, const Bodies& bodies) {
    vtkNew<vtkIntArray> array;
    array->SetName("body");
    array->SetNumberOfTuples(static_cast<vtkIdType>(bodies.size()));
    for (std::size_t i = 0; i < bodies.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), bodies[i]);
    grid.GetCellData()->AddArray(array);
}

template <int Dim>
void add_point(vtkPoints& points, const Vector<Dim>& vertex) {
    std::array<double, 3> x{};
    fill(x.data(), vertex);
    points.InsertNextPoint(x.data());
}

template <int Dim>
vtkSmartPointer<vtkUnstructuredGrid> grid_of_cells(const Mesh<Dim>& mesh) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vector<Dim>& vertex : mesh.vertices) add_point(*points, vertex);
    auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
    grid->SetPoints(points);
    grid->Allocate(mesh.n_cells());
    std::array<vtkIdType, max_cell_vertices> ids{};
    for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
        const CellShape shape = mesh.cell_shape[static_cast<std::size_t>(cell)];
        const auto vertices = mesh.cell_vertices[cell];
        for (std::size_t i = 0; i < vertices.size(); ++i) ids[i] = vertices[vtk_place(shape, i)];
        grid->InsertNextCell(vtk_type(shape), static_cast<vtkIdType>(vertices.size()), ids.data());
    }
    add_bodies(*grid, mesh.cell_body);
    return grid;
}

/// The vertices of the boundary faces, in the order in which the faces name them.
template <int Dim>
std::vector<std::int32_t> surface_vertices(const Mesh<Dim>& mesh) {
    std::vector<char> seen(mesh.vertices.size(), 0);
    std::vector<std::int32_t> vertices;
    for (const std::int32_t face : mesh.boundary_faces)
        for (const std::int32_t vertex : mesh.face_vertices[face])
            if (!std::exchange(seen[static_cast<std::size_t>(vertex)], char{1})) vertices.push_back(vertex);
    return vertices;
}

template <int Dim>
vtkSmartPointer<vtkPolyData> grid_of_surface(const Mesh<Dim>& mesh, const std::vector<std::int32_t>& vertices) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    std::vector<vtkIdType> number(mesh.vertices.size(), -1);
    for (const std::int32_t vertex : vertices) {
        number[static_cast<std::size_t>(vertex)] = points->GetNumberOfPoints();
        add_point(*points, mesh.vertices[static_cast<std::size_t>(vertex)]);
    }
    vtkNew<vtkCellArray> faces;
    std::vector<std::int32_t> bodies;
    for (const std::int32_t face : mesh.boundary_faces) {
        const auto corners = mesh.face_vertices[face];
        faces->InsertNextCell(static_cast<int>(corners.size()));
        for (const std::int32_t vertex : corners) faces->InsertCellPoint(number[static_cast<std::size_t>(vertex)]);
        bodies.push_back(mesh.cell_body[static_cast<std::size_t>(mesh.face_cells[static_cast<std::size_t>(face)][0])]);
    }
    auto surface = vtkSmartPointer<vtkPolyData>::New();
    surface->SetPoints(points);
    if (Dim == 2)
        surface->SetLines(faces);
    else
        surface->SetPolys(faces);
    add_bodies(*surface, bodies);
    return surface;
}

/// Mean over the cells around each vertex. Bodies share no vertex, so nothing mixes between them.
template <int Dim>
std::vector<Vector<Dim>> vertex_means(std::span<const Vector<Dim>> of_cells, const Rows& cell_vertices,
                                      std::size_t n_vertices) {
    std::vector<Vector<Dim>> mean(n_vertices, Vector<Dim>::Zero());
    std::vector<int> count(n_vertices, 0);
    for (std::int32_t cell = 0; cell < cell_vertices.size(); ++cell)
        for (const std::int32_t vertex : cell_vertices[cell]) {
            mean[static_cast<std::size_t>(vertex)] += of_cells[static_cast<std::size_t>(cell)];
            ++count[static_cast<std::size_t>(vertex)];
        }
    for (std::size_t vertex = 0; vertex < n_vertices; ++vertex) mean[vertex] /= count[vertex];
    return mean;
}

}  // namespace

template <int Dim>
struct VtuSeries<Dim>::Files {
    Path directory;
    std::string basename;
    std::vector<double> times{};
    vtkSmartPointer<vtkUnstructuredGrid> cells;
    Rows cell_vertices;
    std::vector<std::int32_t> surface_vertices;
    vtkSmartPointer<vtkPolyData> surface;

    [[nodiscard]] std::size_t n_cells() const { return static_cast<std::size_t>(cells->GetNumberOfCells()); }
    [[nodiscard]] std::size_t n_vertices() const { return static_cast<std::size_t>(cells->GetNumberOfPoints()); }
    [[nodiscard]] std::size_t n_boundary_faces() const { return static_cast<std::size_t>(surface->GetNumberOfCells()); }
    [[nodiscard]] std::string surface_name() const { return basename + "_surface"; }
    void add_displacement(const Frame<Dim>& frame, vtkDataSet& of_cells, vtkDataSet& of_surface) const;
    void add_vertex_displacement(std::span<const Vector<Dim>> at_vertices, vtkDataSet& of_cells,
                                 vtkDataSet& of_surface) const;
    void publish_lists(const std::vector<double>& new_times);
};

/// Both lists or none: where the second cannot be moved, the first is put back.
template <int Dim>
void VtuSeries<Dim>::Files::publish_lists(const std::vector<double>& new_times) {
    PreparedFile of_cells = prepared_list(directory, basename, ".vtu", new_times);
    PreparedFile of_surface = prepared_list(directory, surface_name(), ".vtp", new_times);
    of_cells.move_into_place();
    try {
        of_surface.move_into_place();
    } catch (const MeshError&) {
        prepared_list(directory, basename, ".vtu", times).move_into_place();
        throw;
    }
    times = new_times;
}

template <int Dim>
void VtuSeries<Dim>::Files::add_displacement(const Frame<Dim>& frame, vtkDataSet& of_cells, vtkDataSet& of_surface) const {
    if (!frame.displacement.empty())
        add_field(*of_cells.GetCellData(), vtk_array("displacement", frame.displacement), n_cells(), "cells", "VtuSeries");
    if (!frame.vertex_displacement.empty())
        add_vertex_displacement(frame.vertex_displacement, of_cells, of_surface);
    else if (!frame.displacement.empty())
        add_vertex_displacement(vertex_means(frame.displacement, cell_vertices, n_vertices()), of_cells, of_surface);
}

template <int Dim>
void VtuSeries<Dim>::Files::add_vertex_displacement(std::span<const Vector<Dim>> at_vertices, vtkDataSet& of_cells,
                                                    vtkDataSet& of_surface) const {
    add_field(*of_cells.GetPointData(), vtk_array("displacement", at_vertices), n_vertices(), "vertices", "VtuSeries");
    std::vector<Vector<Dim>> on_surface;
    for (const std::int32_t vertex : surface_vertices) on_surface.push_back(at_vertices[static_cast<std::size_t>(vertex)]);
    of_surface.GetPointData()->AddArray(vtk_array("displacement", std::span<const Vector<Dim>>(on_surface)));
}

template <int Dim>
VtuSeries<Dim>::VtuSeries(const Path& directory, const std::string& basename, const Mesh<Dim>& mesh) {
    make_directory(directory);
    auto vertices = surface_vertices(mesh);
    auto surface = grid_of_surface(mesh, vertices);
    files_.reset(new Files{directory, basename, {}, grid_of_cells(mesh), mesh.cell_vertices, std::move(vertices), surface});
}

template <int Dim>
VtuSeries<Dim>::~VtuSeries() = default;
template <int Dim>
VtuSeries<Dim>::VtuSeries(VtuSeries&&) noexcept = default;
template <int Dim>
VtuSeries<Dim>& VtuSeries<Dim>::operator=(VtuSeries&&) noexcept = default;

template <int Dim>
int VtuSeries<Dim>::n_frames() const {
    return static_cast<int>(files_->times.size());
}

template <int Dim>
const std::vector<double>& VtuSeries<Dim>::times() const {
    return files_->times;
}

template <int Dim>
void VtuSeries<Dim>::go_on_after(std::vector<double> times) {
    require_frames(files_->directory, files_->basename, ".vtu", times.size());
    require_frames(files_->directory, files_->surface_name(), ".vtp", times.size());
    files_->publish_lists(times);
}

template <int Dim>
void VtuSeries<Dim>::write(const Frame<Dim>& frame) {
    vtkNew<vtkUnstructuredGrid> cells;
    vtkNew<vtkPolyData> surface;
    cells->ShallowCopy(files_->cells);
    surface->ShallowCopy(files_->surface);
    files_->add_displacement(frame, *cells, *surface);
    add_fields<Dim>(*cells->GetCellData(), frame.cell_fields, files_->n_cells(), "cells", "VtuSeries");
    add_fields<Dim>(*surface->GetCellData(), frame.boundary_fields, files_->n_boundary_faces(), "boundary faces",
                    "VtuSeries");

    auto times = files_->times;
    auto of_cells = prepared_grid<vtkXMLUnstructuredGridWriter>(
        *cells, files_->directory / frame_name(files_->basename, times.size(), ".vtu"));
    auto of_surface = prepared_grid<vtkXMLPolyDataWriter>(
        *surface, files_->directory / frame_name(files_->surface_name(), times.size(), ".vtp"));
    of_cells.move_into_place();
    of_surface.move_into_place();
    times.push_back(frame.time);
    files_->publish_lists(times);
}

template <int Dim>
void write_vtu(const Mesh<Dim>& mesh, const Path& path) {
    prepared_grid<vtkXMLUnstructuredGridWriter>(*grid_of_cells(mesh), path).move_into_place();
}

template class VtuSeries<2>;
template class VtuSeries<3>;
template void write_vtu<2>(const Mesh<2>&, const Path&);
template void write_vtu<3>(const Mesh<3>&, const Path&);

}  // namespace abut::mesh
