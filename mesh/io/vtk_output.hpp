#pragma once
// Private to the layer; not installed.
#include <vtkDataObject.h>
#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkXMLWriter.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

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
inline constexpr int n_components = 6;
template <>
inline constexpr int n_components<double> = 1;
template <int Dim>
inline constexpr int n_components<Vector<Dim>> = 3;

/// "XX", "YY", ... where the array holds tensors.
void name_components(vtkDataArray& array);

template <class Value>
[[nodiscard]] vtkSmartPointer<vtkDataArray> vtk_array(const std::string& name, std::span<const Value> values) {
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name.c_str());
    array->SetNumberOfComponents(n_components<Value>);
    array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
    name_components(*array);
    double* tuple = array->GetPointer(0);
    for (const Value& value : values) {
        fill(tuple, value);
        tuple += n_components<Value>;
    }
    return array;
}

/// Throws BadInput "<writer>: field '...' has 7 values, one for each of the 8 <of_what> is needed."
void add_field(vtkDataSetAttributes& data, vtkDataArray* array, std::size_t wanted, const char* of_what, const char* writer);

template <int Dim>
void add_fields(vtkDataSetAttributes& data, std::span<const Field<Dim>> fields, std::size_t wanted, const char* of_what,
                const char* writer) {
    for (const Field<Dim>& field : fields)
        std::visit([&](const auto& values) { add_field(data, vtk_array(field.name, values), wanted, of_what, writer); },
                   field.values);
}

/// Writes through `writer`, binary and compressed. Throws MeshError naming the path and the reason.
[[nodiscard]] PreparedFile prepared_grid(vtkXMLWriter& writer, vtkDataObject& grid, const std::filesystem::path& path);

template <class Writer>
[[nodiscard]] PreparedFile prepared_grid(vtkDataObject& grid, const std::filesystem::path& path) {
    const vtkNew<Writer> writer;
    return prepared_grid(*writer.Get(), grid, path);
}

}  // namespace abut::mesh
