#include "abut/mesh/io/write_vtu.hpp"

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
OutputGrid grid_of_all(const Mesh<Dim>& mesh) {
    return grid_of_cells(mesh, all_of(static_cast<std::size_t>(mesh.n_cells())), all_of(mesh.vertices.size()));
}

}  // namespace

template <int Dim>
struct VtuSeries<Dim>::Files {
    Path directory;
    std::string basename;
    std::vector<double> times{};
    OutputGrid cells{};
    Rows cell_vertices{};
    std::vector<std::int32_t> surface_vertices{};
    OutputGrid surface{};

    /// Arrays of one frame.
    struct FrameData {
        std::vector<OutputArray> of_points, of_cells, of_surface_points, of_faces;
    };

    [[nodiscard]] std::string surface_name() const { return basename + "_surface"; }
    void add_displacement(const Frame<Dim>& frame, FrameData& data) const;
    void add_vertex_displacement(std::span<const Vector<Dim>> at_vertices, FrameData& data) const;
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
void VtuSeries<Dim>::Files::add_displacement(const Frame<Dim>& frame, FrameData& data) const {
    if (!frame.displacement.empty())
        add_field(data.of_cells, "displacement", frame.displacement, cells.n_cells, "cells", "VtuSeries");
    if (!frame.vertex_displacement.empty())
        add_vertex_displacement(frame.vertex_displacement, data);
    else if (!frame.displacement.empty())
        add_vertex_displacement(vertex_means<Dim>(frame.displacement, cell_vertices, cells.n_points), data);
}

template <int Dim>
void VtuSeries<Dim>::Files::add_vertex_displacement(std::span<const Vector<Dim>> at_vertices, FrameData& data) const {
    add_field(data.of_points, "displacement", at_vertices, cells.n_points, "vertices", "VtuSeries");
    std::vector<Vector<Dim>> on_surface;
    for (const std::int32_t vertex : surface_vertices) on_surface.push_back(at_vertices[static_cast<std::size_t>(vertex)]);
    data.of_surface_points.push_back(field_array("displacement", std::span<const Vector<Dim>>(on_surface)));
}

template <int Dim>
VtuSeries<Dim>::VtuSeries(const Path& directory, const std::string& basename, const Mesh<Dim>& mesh)
    : files_(new Files{.directory = directory, .basename = basename}) {
    make_folders(directory);
    take_mesh(mesh);
}

template <int Dim>
void VtuSeries<Dim>::take_mesh(const Mesh<Dim>& mesh) {
    const std::vector<std::int32_t> boundary = all_of(mesh.boundary_faces.size());
    files_->cells = grid_of_all(mesh);
    files_->cell_vertices = mesh.cell_vertices;
    files_->surface_vertices = surface_vertices(mesh, boundary);
    files_->surface = grid_of_surface(mesh, boundary, files_->surface_vertices);
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
    typename Files::FrameData data;
    files_->add_displacement(frame, data);
    add_fields<Dim>(data.of_cells, frame.cell_fields, files_->cells.n_cells, "cells", "VtuSeries");
    add_fields<Dim>(data.of_faces, frame.boundary_fields, files_->surface.n_cells, "boundary faces", "VtuSeries");

    auto times = files_->times;
    const std::string time = field_time(frame.time);
    auto of_cells = prepared_grid(files_->cells, files_->directory / frame_path(files_->basename, times.size(), ".vtu"),
                                  time, data.of_points, data.of_cells);
    auto of_surface =
        prepared_grid(files_->surface, files_->directory / frame_path(files_->surface_name(), times.size(), ".vtp"), time,
                      data.of_surface_points, data.of_faces);
    of_cells.move_into_place();
    of_surface.move_into_place();
    times.push_back(frame.time);
    files_->publish_lists(times);
}

template <int Dim>
void write_vtu(const Mesh<Dim>& mesh, const Path& path) {
    prepared_grid(grid_with_groups(mesh), path).move_into_place();
}

template <int Dim>
FieldTuples field_tuples(const FieldValues<Dim>& values) {
    return std::visit([](const auto& v) { return tuples_of(v); }, values);
}

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

template FieldTuples field_tuples<2>(const FieldValues<2>&);
template FieldTuples field_tuples<3>(const FieldValues<3>&);
template std::vector<Vector<2>> vertex_means<2>(std::span<const Vector<2>>, const Rows&, std::size_t);
template std::vector<Vector<3>> vertex_means<3>(std::span<const Vector<3>>, const Rows&, std::size_t);
template class VtuSeries<2>;
template class VtuSeries<3>;
template void write_vtu<2>(const Mesh<2>&, const Path&);
template void write_vtu<3>(const Mesh<3>&, const Path&);

}  // namespace abut::mesh
