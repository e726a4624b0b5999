#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace abut::mesh {

/// Numbers of a VTK file under one name.
struct NamedArray {
    enum class Of { grid, points, cells };

    std::string name;
    Of of = Of::grid;
    std::size_t n_components = 1;
    std::vector<double> values;  ///< (n, n_components)
};

/// Numbers of a .vtu or .vtp file, except the faces of polyhedra: of the grid "points" (n, 3), "corners" (the points of all
/// cells), "ends" (of the corners of each cell) and "types"; then the arrays on points, then those on cells, in the order of
/// the file. A file with another ending is read as .vtu. Throws MeshError as `read_vtu`.
[[nodiscard]] std::vector<NamedArray> read_arrays(const std::filesystem::path& path);

}  // namespace abut::mesh
