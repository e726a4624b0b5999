#pragma once
// Private to the layer; not installed.
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/mesh/io/file.hpp"
#include "abut/mesh/io/write_vtu.hpp"

namespace abut::mesh {

/// One tuple of a VTK array: 2D vectors get a third component 0, of a tensor the symmetric part is taken.
inline void fill(double* tuple, double value) { tuple[0] = value; }
template <int Dim>
void fill(double* tuple, const Vector<Dim>& value) {
    for (int i = 0; i < 3; ++i) tuple[i] = i < Dim ? value[i] : 0.0;
}
template <int Dim>
void fill(double* tuple, const Matrix<Dim>& value) {
    constexpr std::array<std::array<int, 2>, 6> entries = {{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    for (const auto& [row, column] : entries)
        *tuple++ = row < Dim && column < Dim ? 0.5 * (value(row, column) + value(column, row)) : 0.0;
}

template <class Value>
inline constexpr std::size_t n_components = 6;
template <>
inline constexpr std::size_t n_components<double> = 1;
template <int Dim>
inline constexpr std::size_t n_components<Vector<Dim>> = 3;

/// The attributes of an array's tag: its type, name, and number and names of components ("XX", "YY", ... of tensors).
[[nodiscard]] std::string array_attributes(const char* type, const std::string& name, std::size_t n_components = 1);
/// Text in an attribute in quotation marks.
[[nodiscard]] std::string in_xml(const std::string& text);
/// The lines in front of what a file of this type holds.
[[nodiscard]] std::string vtk_head(const std::string& type);

/// An array as a file will hold it.
struct OutputArray {
    std::string attributes;
    std::string blocks;  ///< the values, compressed (`zlib_blocks`)
};
[[nodiscard]] OutputArray output_array(const std::string& name, std::span<const std::uint8_t> values);
[[nodiscard]] OutputArray output_array(const std::string& name, std::span<const std::int32_t> values);
[[nodiscard]] OutputArray output_array(const std::string& name, std::span<const std::int64_t> values);
/// Values of tuples of so many components.
[[nodiscard]] OutputArray output_array(const std::string& name, std::span<const double> values, std::size_t n_components);

template <class Value>
[[nodiscard]] FieldTuples tuples_of(std::span<const Value> values) {
    FieldTuples tuples{n_components<Value>, std::vector<double>(n_components<Value> * values.size())};
    for (std::size_t i = 0; i < values.size(); ++i) fill(tuples.values.data() + n_components<Value> * i, values[i]);
    return tuples;
}
template <class Value>
[[nodiscard]] OutputArray field_array(const std::string& name, std::span<const Value> values) {
    return output_array(name, tuples_of(values).values, n_components<Value>);
}

/// The tag of a number that a file has as a whole. Text would end meshio: names are those of numbers.
[[nodiscard]] std::string field_number(const std::string& name, double value);
[[nodiscard]] std::string field_number(const std::string& name, std::int32_t value);
/// The time of a frame [s], by the name under which VTK and ParaView look for it.
[[nodiscard]] std::string field_time(double time);

/// Content of a .vtu or .vtp file.
struct OutputGrid {
    std::string type;          ///< "UnstructuredGrid" or "PolyData"
    std::string cell_section;  ///< of its cells: "Cells", "Verts", "Lines" or "Polys"
    std::size_t n_points = 0, n_cells = 0;
    std::vector<OutputArray> points, cells;  ///< positions; corners, their ends and, of unstructured grids, types
    std::vector<OutputArray> point_data{}, cell_data{};
    std::string field_data{};  ///< tags of numbers of the file as a whole
};

template <int Dim>
[[nodiscard]] OutputGrid output_grid(const std::string& type, const std::string& cell_section,
                                     std::span<const Vector<Dim>> points, std::span<const std::int64_t> corners,
                                     std::span<const std::int64_t> ends) {
    return {type,
            cell_section,
            points.size(),
            ends.size(),
            {field_array("Points", points)},
            {output_array("connectivity", corners), output_array("offsets", ends)}};
}

/// Throws BadInput "<writer>: field '...' has 7 values, one for each of the 8 <of_what> is needed."
void check_size(const std::string& field, std::size_t n, std::size_t wanted, const char* of_what, const char* writer);

/// Adds an array with one value for each point or cell. Throws as `check_size`.
template <class Value>
void add_field(std::vector<OutputArray>& data, const std::string& name, std::span<const Value> values, std::size_t wanted,
               const char* of_what, const char* writer) {
    check_size(name, values.size(), wanted, of_what, writer);
    data.push_back(field_array(name, values));
}
template <int Dim>
void add_fields(std::vector<OutputArray>& data, std::span<const Field<Dim>> fields, std::size_t wanted, const char* of_what,
                const char* writer) {
    for (const Field<Dim>& field : fields)
        std::visit([&](const auto& values) { add_field(data, field.name, values, wanted, of_what, writer); }, field.values);
}

/// A file of this grid with more arrays and tags of field data behind its own. Throws MeshError naming the path and the
/// reason.
[[nodiscard]] PreparedFile prepared_grid(const OutputGrid& grid, const std::filesystem::path& path,
                                         const std::string& more_field_data = "",
                                         std::span<const OutputArray> more_point_data = {},
                                         std::span<const OutputArray> more_cell_data = {});

}  // namespace abut::mesh
