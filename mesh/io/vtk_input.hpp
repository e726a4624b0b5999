#pragma once
// Private to the layer; not installed.
#include <vtkDataSet.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::mesh {

/// What a .vtu or .vtp file holds. Throws MeshError if it is missing, empty, truncated, of another type, or if VTK
/// complains.
[[nodiscard]] vtkSmartPointer<vtkUnstructuredGrid> read_unstructured_grid(const std::filesystem::path& path);
[[nodiscard]] vtkSmartPointer<vtkPolyData> read_poly_data(const std::filesystem::path& path);

/// Value of the array "body" in each VTK cell; empty without that array. Throws MeshError for a value that is no whole
/// number.
[[nodiscard]] std::vector<std::int64_t> body_values(const std::string& name, vtkDataSet& grid);

/// Replaces values of the array "body" by indices into the names that are returned: "body_<value>" in increasing order.
[[nodiscard]] std::vector<std::string> names_of_bodies(std::vector<std::int64_t>& values);

}  // namespace abut::mesh
