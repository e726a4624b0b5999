#include "abut/mesh/io/write_vtu.hpp"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <utility>

#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/series_files.hpp"
#include "abut/mesh/io/vtk_grids.hpp"
#include "abut/mesh/io/vtk_output.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

using Path = std::filesystem::path;

template <int Dim>
vtkSmartPointer<vtkUnstructuredGrid> grid_of_all(const Mesh<Dim>& mesh) {
    return grid_of_cells(mesh, all_of(static_cast<std::size_t>(mesh.n_cells())), all_of(mesh.vertices.size()));
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
    const std::vector<std::int32_t> boundary = all_of(mesh.boundary_faces.size());
    auto vertices = surface_vertices(mesh, boundary);
    auto surface = grid_of_surface(mesh, boundary, vertices);
    files_.reset(new Files{directory, basename, {}, grid_of_all(mesh), mesh.cell_vertices, std::move(vertices), surface});
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
    prepared_grid<vtkXMLUnstructuredGridWriter>(*grid_of_all(mesh), path).move_into_place();
}

template class VtuSeries<2>;
template class VtuSeries<3>;
template void write_vtu<2>(const Mesh<2>&, const Path&);
template void write_vtu<3>(const Mesh<3>&, const Path&);

}  // namespace abut::mesh
