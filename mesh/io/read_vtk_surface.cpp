#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <limits>

#include "abut/mesh/io/read_vtu.hpp"
#include "abut/mesh/io/surface_readers.hpp"
#include "abut/mesh/io/vtk_input.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

/// The named point array; empty without it.
std::vector<Vector<3>> point_vectors(const std::string& file, vtkDataSet& grid, const SurfaceOptions& options) {
    if (options.displacement.empty()) return {};
    vtkDataArray* array = grid.GetPointData()->GetArray(options.displacement.c_str());
    if (array == nullptr) {
        if (options.displacement == SurfaceOptions{}.displacement) return {};
        std::string names;
        for (int i = 0; i < grid.GetPointData()->GetNumberOfArrays(); ++i)
            names += std::string(i > 0 ? ", '" : "'") + grid.GetPointData()->GetAbstractArray(i)->GetName() + "'";
        throw MeshError(file + ": has no point array '" + options.displacement + "'; there is " +
                        (names.empty() ? "none" : names) + ". Correct the name (SurfaceOptions::displacement).");
    }
    if (array->GetNumberOfComponents() != 3)
        throw MeshError(file + ": the point array '" + options.displacement + "' has " +
                        std::to_string(array->GetNumberOfComponents()) +
                        " components, a displacement has 3. Name another array (SurfaceOptions::displacement).");
    std::vector<Vector<3>> vectors(static_cast<std::size_t>(array->GetNumberOfTuples()));
    for (std::size_t i = 0; i < vectors.size(); ++i) array->GetTuple(static_cast<vtkIdType>(i), vectors[i].data());
    return vectors;
}

void read_points(SurfaceMesh& mesh, vtkPointSet& grid) {
    const vtkIdType n = grid.GetNumberOfPoints();
    if (n > std::numeric_limits<std::int32_t>::max())
        throw MeshError(mesh.name + ": has " + std::to_string(n) +
                        " points, at most 2147483647 are allowed. Coarsen the surface.");
    mesh.vertices.resize(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) grid.GetPoint(static_cast<vtkIdType>(i), mesh.vertices[i].data());
}

/// Every face of one cell of the file; none, and counted, if it is no surface.
class FaceCollector {
public:
    FaceCollector(SurfaceMesh& mesh, std::vector<std::int64_t> body_values)
        : mesh_(mesh), body_values_(std::move(body_values)) {}

    void add_cell(int type, vtkIdList& ids, vtkIdType cell) {
        const auto n = static_cast<std::size_t>(ids.GetNumberOfIds());
        corners_.resize(n);
        for (std::size_t i = 0; i < n; ++i) corners_[i] = index_of(ids.GetId(static_cast<vtkIdType>(i)));
        if (type == VTK_TRIANGLE_STRIP)
            add_strip(cell);
        else if (type == VTK_PIXEL && n == 4)
            add({{corners_[0], corners_[1], corners_[3], corners_[2]}}, cell);
        else if (type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_POLYGON)
            add(corners_, cell);
        else
            ++mesh_.n_ignored_elements;
    }
    void name_bodies() {
        if (body_values_.empty()) return;
        mesh_.body_names = names_of_bodies(bodies_);
        for (const std::int64_t body : bodies_) mesh_.face_body.push_back(static_cast<std::int32_t>(body));
    }

private:
    static std::int32_t index_of(vtkIdType id) {
        return id < 0 ? -1 : static_cast<std::int32_t>(std::min<vtkIdType>(id, std::numeric_limits<std::int32_t>::max()));
    }
    void add(const std::vector<std::int32_t>& corners, vtkIdType cell) {
        mesh_.faces.append(corners);
        mesh_.face_label.push_back(cell);
        if (!body_values_.empty()) bodies_.push_back(body_values_[static_cast<std::size_t>(cell)]);
    }
    /// Every other triangle of a strip runs the other way.
    void add_strip(vtkIdType cell) {
        for (std::size_t i = 0; i + 2 < corners_.size(); ++i)
            add({corners_[i], corners_[i + 1 + i % 2], corners_[i + 2 - i % 2]}, cell);
    }

    SurfaceMesh& mesh_;
    std::vector<std::int64_t> body_values_, bodies_;
    std::vector<std::int32_t> corners_;
};

bool has_dimension_3(int type) {
    switch (type) {
        case VTK_EMPTY_CELL:
        case VTK_VERTEX:
        case VTK_POLY_VERTEX:
        case VTK_LINE:
        case VTK_POLY_LINE:
        case VTK_TRIANGLE:
        case VTK_TRIANGLE_STRIP:
        case VTK_POLYGON:
        case VTK_PIXEL:
        case VTK_QUAD:
            return false;
        default:
            return true;  // read_vtu knows which it can read
    }
}

bool has_volume(vtkUnstructuredGrid& grid) {
    for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell)
        if (has_dimension_3(grid.GetCellType(cell))) return true;
    return false;
}

/// In the order of the vertices of the mesh, which `build_mesh` may have changed.
std::vector<Vector<3>> at_vertices_of(const Mesh<3>& mesh, const std::vector<Vector<3>>& at_points) {
    std::vector<Vector<3>> result;
    if (at_points.empty()) return result;
    for (const std::int64_t point : mesh.vertex_label) result.push_back(at_points[static_cast<std::size_t>(point)]);
    return result;
}

}  // namespace

SurfaceMesh read_vtp_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
    SurfaceMesh mesh;
    mesh.name = path.string();
    const auto grid = read_poly_data(path);
    read_points(mesh, *grid);
    mesh.displacement = point_vectors(mesh.name, *grid, options);
    FaceCollector faces(mesh, body_values(mesh.name, *grid));
    vtkNew<vtkIdList> ids;
    vtkIdType cell = grid->GetNumberOfVerts() + grid->GetNumberOfLines();  // cells are numbered through
    mesh.n_ignored_elements = static_cast<std::int32_t>(cell);
    for (vtkIdType i = 0; i < grid->GetNumberOfPolys(); ++i) {
        grid->GetPolys()->GetCellAtId(i, ids);
        faces.add_cell(VTK_POLYGON, *ids, cell++);
    }
    for (vtkIdType i = 0; i < grid->GetNumberOfStrips(); ++i) {
        grid->GetStrips()->GetCellAtId(i, ids);
        faces.add_cell(VTK_TRIANGLE_STRIP, *ids, cell++);
    }
    faces.name_bodies();
    return mesh;
}

SurfaceMesh read_vtu_surface(const std::filesystem::path& path, const SurfaceOptions& options) {
    SurfaceMesh mesh;
    mesh.name = path.string();
    const auto grid = read_unstructured_grid(path);
    mesh.displacement = point_vectors(mesh.name, *grid, options);
    if (has_volume(*grid)) {
        const Mesh<3> volume = read_vtu<3>(path, options.volume);
        return boundary_of(volume, at_vertices_of(volume, mesh.displacement));
    }
    read_points(mesh, *grid);
    FaceCollector faces(mesh, body_values(mesh.name, *grid));
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
        grid->GetCellPoints(cell, ids);
        faces.add_cell(grid->GetCellType(cell), *ids, cell);
    }
    faces.name_bodies();
    return mesh;
}

}  // namespace abut::mesh
