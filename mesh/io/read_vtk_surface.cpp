#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/io/vtk_input.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

/// The named point array; empty without it.
std::vector<Vector<3>> point_vectors(const std::string& file, const VtkGrid& grid, const SurfaceOptions& options) {
    if (options.displacement.empty()) return {};
    const auto array = std::ranges::find(grid.point_data, options.displacement, &VtkArray::name);
    if (array == grid.point_data.end()) {
        if (options.displacement == SurfaceOptions{}.displacement) return {};
        std::string names;
        for (const VtkArray& other : grid.point_data) names += (names.empty() ? "'" : ", '") + other.name + "'";
        throw MeshError(file + ": has no point array '" + options.displacement + "'; there is " +
                        (names.empty() ? "none" : names) + ". Correct the name (SurfaceOptions::displacement).");
    }
    if (array->n_components != 3)
        throw MeshError(file + ": the point array '" + options.displacement + "' has " +
                        std::to_string(array->n_components) +
                        " components, a displacement has 3. Name another array (SurfaceOptions::displacement).");
    std::vector<Vector<3>> vectors;
    for (std::size_t i = 0; i < array->values.size(); i += 3) vectors.emplace_back(array->values.data() + i);
    return vectors;
}

/// Every face of one cell of the file; none, and counted, if it is no surface.
class FaceCollector {
public:
    FaceCollector(SurfaceMesh& mesh, const VtkGrid& grid)
        : mesh_(mesh), grid_(grid), body_values_(body_values(mesh.name, grid)) {}

    void add_cell(std::int64_t type, std::span<const std::int64_t> ids, std::size_t cell) {
        corners_.resize(ids.size());
        std::ranges::transform(ids, corners_.begin(), index_of);
        if (type == vtk_triangle_strip)
            add_strip(cell);
        else if (type == vtk_pixel && ids.size() == 4)
            add({{corners_[0], corners_[1], corners_[3], corners_[2]}}, cell);
        else if (type == vtk_triangle || type == vtk_quad || type == vtk_polygon)
            add(corners_, cell);
        else
            ++mesh_.n_ignored_elements;
    }
    void name_bodies() {
        if (body_values_.empty()) return;
        mesh_.body_names = names_of_bodies(bodies_, grid_);
        for (const std::int64_t body : bodies_) mesh_.face_body.push_back(static_cast<std::int32_t>(body));
    }

private:
    static std::int32_t index_of(std::int64_t id) {
        return id < 0 ? -1 : static_cast<std::int32_t>(std::min<std::int64_t>(id, std::numeric_limits<std::int32_t>::max()));
    }
    void add(const std::vector<std::int32_t>& corners, std::size_t cell) {
        mesh_.faces.append(corners);
        mesh_.face_label.push_back(static_cast<std::int64_t>(cell));
        if (!body_values_.empty()) bodies_.push_back(body_values_[cell]);
    }
    /// Every other triangle of a strip runs the other way.
    void add_strip(std::size_t cell) {
        for (std::size_t i = 0; i + 2 < corners_.size(); ++i)
            add({corners_[i], corners_[i + 1 + i % 2], corners_[i + 2 - i % 2]}, cell);
    }

    SurfaceMesh& mesh_;
    const VtkGrid& grid_;
    std::vector<std::int64_t> body_values_, bodies_;
    std::vector<std::int32_t> corners_;
};

bool has_dimension_3(std::int64_t type) {
    switch (type) {
        case vtk_empty_cell:
        case vtk_vertex:
        case vtk_poly_vertex:
        case vtk_line:
        case vtk_poly_line:
        case vtk_triangle:
        case vtk_triangle_strip:
        case vtk_polygon:
        case vtk_pixel:
        case vtk_quad:
            return false;
        default:
            return true;  // read_vtu knows which it can read
    }
}

/// In the order of the vertices of the mesh, which `build_mesh` may have changed.
std::vector<Vector<3>> at_vertices_of(const Mesh<3>& mesh, const std::vector<Vector<3>>& at_points) {
    std::vector<Vector<3>> result;
    if (at_points.empty()) return result;
    for (const std::int64_t point : mesh.vertex_label) result.push_back(at_points[static_cast<std::size_t>(point)]);
    return result;
}

SurfaceMesh surface_of(const std::filesystem::path& path, VtkGrid grid, std::vector<Vector<3>> displacement) {
    SurfaceMesh mesh;
    mesh.name = path.string();
    mesh.displacement = std::move(displacement);
    mesh.vertices = std::move(grid.points);
    FaceCollector faces(mesh, grid);
    for (std::size_t cell = 0; cell < grid.n_cells(); ++cell)
        faces.add_cell(grid.cell_types[cell], grid.corners_of(cell), cell);
    faces.name_bodies();
    return mesh;
}

}  // namespace

SurfaceMesh read_vtp_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
    VtkGrid grid = read_vtk_grid(path, VtkKind::poly_data);
    auto displacement = point_vectors(path.string(), grid, options);
    return surface_of(path, std::move(grid), std::move(displacement));
}

SurfaceMesh read_vtu_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
    VtkGrid grid = read_vtk_grid(path, VtkKind::unstructured_grid);
    auto displacement = point_vectors(path.string(), grid, options);
    if (std::ranges::any_of(grid.cell_types, has_dimension_3)) {
        const Mesh<3> volume = mesh_of<3>(grid, path.string(), options.volume);
        return boundary_of(volume, at_vertices_of(volume, displacement));
    }
    return surface_of(path, std::move(grid), std::move(displacement));
}

}  // namespace abut::mesh
