#pragma once
// Arrays of VTU and VTP files for tests, by the library's own reader; mesh/check_vtk_files.py compares it with VTK's.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/mesh/io/vtk_input.hpp"

namespace abut::mesh::test {

inline VtkGrid read_grid(const std::filesystem::path& path) {
    return read_vtk_grid(path, path.extension() == ".vtp" ? VtkKind::poly_data : VtkKind::unstructured_grid);
}

/// Null where no array has that name.
inline const VtkArray* find_array(const std::vector<VtkArray>& arrays, const std::string& name) {
    const auto found = std::ranges::find(arrays, name, &VtkArray::name);
    return found == arrays.end() ? nullptr : &*found;
}

inline double component(const VtkArray* array, std::size_t tuple, std::size_t k) {
    return array->values.at(tuple * array->n_components + k);
}

}  // namespace abut::mesh::test
