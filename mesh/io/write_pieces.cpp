#include "abut/mesh/io/write_pieces.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/series_files.hpp"
#include "abut/mesh/io/vtk_grids.hpp"
#include "abut/mesh/io/vtk_output.hpp"
#include "abut/mesh/io/write_vtu.hpp"

namespace abut::mesh {
namespace {

constexpr const char* cells_extension = ".pvtu";
constexpr const char* surface_extension = ".pvtp";

std::string surface_name(const std::string& basename) { return basename + "_surface"; }
std::string piece_extension(int piece, const char* extension) { return "_" + std::to_string(piece) + extension; }

/// An array as a head of pieces declares it.
std::string array_line(const std::string& name, std::size_t width, const char* type = "Float64") {
    return "<PDataArray " + array_attributes(type, name, width) + "/>\n";
}

template <int Dim>
std::string field_lines(const std::vector<Field<Dim>>& fields) {
    std::string lines;
    for (const Field<Dim>& field : fields)
        lines += std::visit(
            [&](const auto& values) {
                using Value = std::remove_cv_t<typename std::decay_t<decltype(values)>::value_type>;
                return array_line(field.name, n_components<Value>);
            },
            field.values);
    return lines;
}

/// The file that names the pieces of a frame; its cells have these arrays.
std::string head_of_pieces(const std::string& kind, double time, const std::string& arrays,
                           const std::vector<std::string>& pieces) {
    std::string text = vtk_head(kind) + "<FieldData>\n" + field_time(time) + "</FieldData>\n<PPointData>\n" +
                       array_line("displacement", 3) + "</PPointData>\n<PCellData>\n" + arrays +
                       "</PCellData>\n<PPoints>\n" + array_line("Points", 3) + "</PPoints>\n";
    for (const std::string& piece : pieces) text += "<Piece Source=\"" + in_xml(piece) + "\"/>\n";
    return text + "</" + kind + ">\n</VTKFile>\n";
}

std::vector<std::string> piece_names(const std::string& basename, std::size_t frame, int n_pieces, const char* extension) {
    std::vector<std::string> names;
    for (int piece = 0; piece < n_pieces; ++piece)
        names.push_back(frame_name(basename, frame, piece_extension(piece, extension).c_str()));
    return names;
}

/// Values of the vertices of the boundary faces, from those of the cells of a piece.
template <int Dim>
std::vector<Vector<Dim>> on_surface(const PieceFrame<Dim>& frame, const std::vector<std::int32_t>& vertices) {
    std::vector<Vector<Dim>> values;
    for (const std::int32_t vertex : vertices)
        values.push_back(frame.vertex_displacement[static_cast<std::size_t>(
            std::ranges::lower_bound(frame.vertices, vertex) - frame.vertices.begin())]);
    return values;
}

}  // namespace

template <int Dim>
void write_piece(const std::filesystem::path& directory, const std::string& basename, std::size_t frame_number, int piece,
                 const Mesh<Dim>& mesh, const PieceFrame<Dim>& frame) {
    constexpr const char* writer = "write_piece";
    OutputGrid cells = grid_of_cells(mesh, frame.cells, frame.vertices);
    cells.field_data += field_time(frame.time);
    cells.cell_data.push_back(output_array("cell", frame.cell_number));
    add_field(cells.cell_data, "displacement", frame.displacement, cells.n_cells, "cells", writer);
    add_field(cells.point_data, "displacement", frame.vertex_displacement, cells.n_points, "vertices", writer);
    add_fields<Dim>(cells.cell_data, frame.cell_fields, cells.n_cells, "cells", writer);

    const std::vector<std::int32_t> vertices = surface_vertices(mesh, frame.boundary);
    const std::vector<Vector<Dim>> at_vertices = on_surface(frame, vertices);
    OutputGrid surface = grid_of_surface(mesh, frame.boundary, vertices);
    surface.field_data += field_time(frame.time);
    surface.cell_data.push_back(output_array("face", frame.face_number));
    surface.point_data.push_back(field_array("displacement", std::span<const Vector<Dim>>(at_vertices)));
    add_fields<Dim>(surface.cell_data, frame.boundary_fields, surface.n_cells, "boundary faces", writer);

    const auto path = [&](const std::string& name, const char* extension) {
        return directory / frame_path(name, frame_number, piece_extension(piece, extension).c_str());
    };
    make_folders(directory);  // which another rank may not have made yet
    auto of_cells = prepared_grid(cells, path(basename, ".vtu"));
    auto of_surface = prepared_grid(surface, path(surface_name(basename), ".vtp"));
    of_cells.move_into_place();
    of_surface.move_into_place();
}

PieceSeries::PieceSeries(std::filesystem::path directory, std::string basename)
    : directory_(std::move(directory)), basename_(std::move(basename)) {
    make_folders(directory_);
}

template <int Dim>
void PieceSeries::publish(int n_pieces, const Mesh<Dim>& mesh, const PieceFrame<Dim>& frame) {
    const std::string surface = surface_name(basename_);
    const std::string numbers = array_line("body", 1, "Int32");
    std::string groups;
    for (const BoundaryGroup& group : mesh.groups) groups += array_line(group_array(group.name), 1, "UInt8");
    prepared_text(directory_ / frame_path(basename_, n_frames(), cells_extension),
                  head_of_pieces("PUnstructuredGrid", frame.time,
                                 numbers + array_line("cell", 1, "Int32") + array_line("displacement", 3) +
                                     field_lines(frame.cell_fields),
                                 piece_names(basename_, n_frames(), n_pieces, ".vtu")))
        .move_into_place();
    prepared_text(directory_ / frame_path(surface, n_frames(), surface_extension),
                  head_of_pieces("PPolyData", frame.time,
                                 numbers + groups + array_line("face", 1, "Int32") + field_lines(frame.boundary_fields),
                                 piece_names(surface, n_frames(), n_pieces, ".vtp")))
        .move_into_place();
    std::vector<double> times = times_;
    times.push_back(frame.time);
    publish_lists(times);
}

void PieceSeries::publish_lists(const std::vector<double>& times) {
    prepared_list(directory_, basename_, cells_extension, times).move_into_place();
    prepared_list(directory_, surface_name(basename_), surface_extension, times).move_into_place();
    times_ = times;
}

void PieceSeries::go_on_after(std::vector<double> times) {
    require_frames(directory_, basename_, cells_extension, times.size());
    require_frames(directory_, surface_name(basename_), surface_extension, times.size());
    publish_lists(times);
}

#define ABUT_INSTANTIATE(Dim)                                                                                            \
    template void PieceSeries::publish<Dim>(int, const Mesh<Dim>&, const PieceFrame<Dim>&);                              \
    template void write_piece<Dim>(const std::filesystem::path&, const std::string&, std::size_t, int, const Mesh<Dim>&, \
                                   const PieceFrame<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::mesh
