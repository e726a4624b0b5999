#include "abut/mesh/io/read_arrays.hpp"

#include <cstdint>
#include <utility>

#include "abut/mesh/io/vtk_input.hpp"

namespace abut::mesh {
namespace {

NamedArray of_grid(const char* name, const std::vector<std::int64_t>& numbers) {
    return {.name = name, .values = std::vector<double>(numbers.begin(), numbers.end())};
}

NamedArray points_of(const VtkGrid& grid) {
    NamedArray points{.name = "points", .n_components = 3, .values = {}};
    points.values.reserve(3 * grid.points.size());
    for (const Vector<3>& x : grid.points)
        for (int i = 0; i < 3; ++i) points.values.push_back(x[i]);
    return points;
}

void append(std::vector<NamedArray>& arrays, std::vector<VtkArray>& more, NamedArray::Of of) {
    for (VtkArray& array : more) arrays.push_back({std::move(array.name), of, array.n_components, std::move(array.values)});
}

}  // namespace

std::vector<NamedArray> read_arrays(const std::filesystem::path& path) {
    VtkGrid grid = read_vtk_grid(path, path.extension() == ".vtp" ? VtkKind::poly_data : VtkKind::unstructured_grid);
    std::vector<NamedArray> arrays{points_of(grid), of_grid("corners", grid.corners), of_grid("ends", grid.cell_ends),
                                   of_grid("types", grid.cell_types)};
    append(arrays, grid.point_data, NamedArray::Of::points);
    append(arrays, grid.cell_data, NamedArray::Of::cells);
    return arrays;
}

}  // namespace abut::mesh
