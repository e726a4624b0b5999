#include "abut/mesh/io/read_vtu.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "abut/geometry/box.hpp"
#include "abut/mesh/connected_bodies.hpp"
#include "abut/mesh/io/other_formats.hpp"
#include "abut/mesh/io/plane_input.hpp"
#include "abut/mesh/io/vtk_input.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {
namespace {

struct VtkShape {
    CellShape shape;
    std::array<int, max_cell_vertices> order;  ///< VTK's index of our vertex
    bool is_curved = false;                    ///< of order 2: more points behind its corners
};

std::optional<VtkShape> shape_of_vtk(int type) {
    constexpr std::array<int, max_cell_vertices> same = {0, 1, 2, 3, 4, 5, 6, 7};
    constexpr std::array<int, max_cell_vertices> lattice = {0, 1, 3, 2, 4, 5, 7, 6};
    switch (type) {
        case VTK_TRIANGLE:
            return VtkShape{CellShape::triangle, same};
        case VTK_QUAD:
            return VtkShape{CellShape::quadrangle, same};
        case VTK_PIXEL:
            return VtkShape{CellShape::quadrangle, lattice};
        case VTK_TETRA:
            return VtkShape{CellShape::tetrahedron, same};
        case VTK_HEXAHEDRON:
            return VtkShape{CellShape::hexahedron, same};
        case VTK_VOXEL:
            return VtkShape{CellShape::hexahedron, lattice};
        case VTK_WEDGE:
            return VtkShape{CellShape::prism, same};
        case VTK_PYRAMID:
            return VtkShape{CellShape::pyramid, same};
        case VTK_QUADRATIC_TRIANGLE:
        case VTK_BIQUADRATIC_TRIANGLE:
            return VtkShape{CellShape::triangle, same, true};
        case VTK_QUADRATIC_QUAD:
        case VTK_BIQUADRATIC_QUAD:
            return VtkShape{CellShape::quadrangle, same, true};
        case VTK_QUADRATIC_TETRA:
            return VtkShape{CellShape::tetrahedron, same, true};
        case VTK_QUADRATIC_HEXAHEDRON:
        case VTK_TRIQUADRATIC_HEXAHEDRON:
            return VtkShape{CellShape::hexahedron, same, true};
        case VTK_QUADRATIC_WEDGE:
        case VTK_BIQUADRATIC_QUADRATIC_WEDGE:
            return VtkShape{CellShape::prism, same, true};
        case VTK_QUADRATIC_PYRAMID:
            return VtkShape{CellShape::pyramid, same, true};
        default:
            return std::nullopt;
    }
}

bool has_lower_dimension(int type, int dimension) {
    const bool point = type == VTK_EMPTY_CELL || type == VTK_VERTEX || type == VTK_POLY_VERTEX;
    const bool line = type == VTK_LINE || type == VTK_POLY_LINE || type == VTK_QUADRATIC_EDGE;
    const bool surface = type == VTK_TRIANGLE || type == VTK_QUAD || type == VTK_PIXEL || type == VTK_POLYGON ||
                         type == VTK_TRIANGLE_STRIP || type == VTK_QUADRATIC_TRIANGLE || type == VTK_BIQUADRATIC_TRIANGLE ||
                         type == VTK_QUADRATIC_QUAD || type == VTK_BIQUADRATIC_QUAD;
    return point || line || (dimension == 3 && surface);
}

template <int Dim>
void read_points(CellSoup<Dim>& soup, vtkUnstructuredGrid& grid, double planarity_tolerance) {
    geometry::Box<3> box;
    soup.vertices.resize(static_cast<std::size_t>(grid.GetNumberOfPoints()));
    for (std::size_t i = 0; i < soup.vertices.size(); ++i) {
        Vector<3> point;
        grid.GetPoint(static_cast<vtkIdType>(i), point.data());
        box.extend(point);
        soup.vertices[i] = point.head<Dim>();
    }
    if (Dim == 2) check_lies_in_plane(soup.name, box, planarity_tolerance);
}

/// Files hold wedges in both orders: turns a prism that is inside out in ours.
template <int Dim>
void turn_wedge(const CellSoup<Dim>& soup, std::array<std::int32_t, max_cell_vertices>& v) {
    if constexpr (Dim == 3) {
        const auto at = [&](std::size_t i) -> const Vector<3>& { return soup.vertices[static_cast<std::size_t>(v[i])]; };
        const Vector<3> base = (at(1) - at(0)).cross(at(2) - at(0));
        if (base.dot(at(3) + at(4) + at(5) - at(0) - at(1) - at(2)) < 0.0)
            std::swap_ranges(v.begin(), v.begin() + 3, v.begin() + 3);
    }
}

template <int Dim>
void append_cell(CellSoup<Dim>& soup, const VtkShape& shape, vtkIdList& ids, vtkIdType cell, std::int32_t body) {
    std::array<std::int32_t, max_cell_vertices> vertices{};
    const auto n = static_cast<std::size_t>(n_vertices(shape.shape));
    for (std::size_t i = 0; i < n; ++i) vertices[i] = static_cast<std::int32_t>(ids.GetId(shape.order[i]));
    if (shape.shape == CellShape::prism) turn_wedge(soup, vertices);
    soup.cell_vertices.append({vertices.data(), n});
    soup.cell_shape.push_back(shape.shape);
    soup.cell_body.push_back(body);
    soup.cell_label.push_back(cell);
}

template <int Dim>
void read_cells(CellSoup<Dim>& soup, vtkUnstructuredGrid& grid) {
    const auto values = body_values(soup.name, grid);
    std::vector<std::int64_t> bodies;
    std::size_t n_curved = 0;
    vtkNew<vtkIdList> ids;
    for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
        const int type = grid.GetCellType(cell);
        const auto shape = shape_of_vtk(type);
        if (has_lower_dimension(type, Dim)) {
            ++soup.n_ignored_elements;
            continue;
        }
        if (!shape || dimension(shape->shape) != Dim)
            throw MeshError(
                soup.name + ": cell " + std::to_string(cell) + " has the VTK cell type " + std::to_string(type) +
                ", which is no cell of a mesh of dimension " + std::to_string(Dim) +
                " here. Convert it to straight-sided triangles, quadrangles, tetrahedra, hexahedra, wedges or pyramids.");
        grid.GetCellPoints(cell, ids);
        const auto n_ids = ids->GetNumberOfIds();
        if (shape->is_curved ? n_ids < n_vertices(shape->shape) : n_ids != n_vertices(shape->shape))
            throw MeshError(soup.name + ": cell " + std::to_string(cell) + " has " + std::to_string(n_ids) + " points, a " +
                            std::string(name(shape->shape)) + " has " + std::to_string(n_vertices(shape->shape)) +
                            ". Write the mesh again.");
        for (vtkIdType i = 0; i < n_ids; ++i)
            if (ids->GetId(i) < 0 || ids->GetId(i) >= grid.GetNumberOfPoints())
                throw MeshError(soup.name + ": cell " + std::to_string(cell) + " has the point " +
                                std::to_string(ids->GetId(i)) + ", the file has " +
                                std::to_string(grid.GetNumberOfPoints()) + ". Write the mesh again.");
        append_cell(soup, *shape, *ids, cell, -1);
        n_curved += shape->is_curved;
        if (!values.empty()) bodies.push_back(values[static_cast<std::size_t>(cell)]);
    }
    if (n_curved > 0) soup.warnings.push_back(about_order_2(n_curved));
    soup.body_names = names_of_bodies(bodies);
    for (std::size_t cell = 0; cell < bodies.size(); ++cell) soup.cell_body[cell] = static_cast<std::int32_t>(bodies[cell]);
    name_connected_bodies(soup);
}

}  // namespace

template <int Dim>
Mesh<Dim> read_vtu(const std::filesystem::path& path, const MeshOptions& options) {
    CellSoup<Dim> soup;
    soup.name = path.string();
    const auto grid = read_unstructured_grid(path);
    read_points(soup, *grid, options.planarity_tolerance);
    read_cells(soup, *grid);
    return build_mesh(std::move(soup), options);
}

template Mesh<2> read_vtu<2>(const std::filesystem::path&, const MeshOptions&);
template Mesh<3> read_vtu<3>(const std::filesystem::path&, const MeshOptions&);

}  // namespace abut::mesh
