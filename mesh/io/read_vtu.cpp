#include "abut/mesh/io/read_vtu.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/base/sort_unique.hpp"
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

std::optional<VtkShape> shape_of_vtk(std::int64_t type) {
    constexpr std::array<int, max_cell_vertices> same = {0, 1, 2, 3, 4, 5, 6, 7};
    constexpr std::array<int, max_cell_vertices> lattice = {0, 1, 3, 2, 4, 5, 7, 6};
    switch (type) {
        case vtk_triangle:
            return VtkShape{CellShape::triangle, same};
        case vtk_quad:
            return VtkShape{CellShape::quadrangle, same};
        case vtk_pixel:
            return VtkShape{CellShape::quadrangle, lattice};
        case vtk_tetra:
            return VtkShape{CellShape::tetrahedron, same};
        case vtk_hexahedron:
            return VtkShape{CellShape::hexahedron, same};
        case vtk_voxel:
            return VtkShape{CellShape::hexahedron, lattice};
        case vtk_wedge:
            return VtkShape{CellShape::prism, same};
        case vtk_pyramid:
            return VtkShape{CellShape::pyramid, same};
        case vtk_quadratic_triangle:
        case vtk_biquadratic_triangle:
            return VtkShape{CellShape::triangle, same, true};
        case vtk_quadratic_quad:
        case vtk_biquadratic_quad:
            return VtkShape{CellShape::quadrangle, same, true};
        case vtk_quadratic_tetra:
            return VtkShape{CellShape::tetrahedron, same, true};
        case vtk_quadratic_hexahedron:
        case vtk_triquadratic_hexahedron:
            return VtkShape{CellShape::hexahedron, same, true};
        case vtk_quadratic_wedge:
        case vtk_biquadratic_quadratic_wedge:
            return VtkShape{CellShape::prism, same, true};
        case vtk_quadratic_pyramid:
            return VtkShape{CellShape::pyramid, same, true};
        default:
            return std::nullopt;
    }
}

bool has_lower_dimension(std::int64_t type, int dimension) {
    const bool point = type == vtk_empty_cell || type == vtk_vertex || type == vtk_poly_vertex;
    const bool line = type == vtk_line || type == vtk_poly_line || type == vtk_quadratic_edge;
    const bool surface = type == vtk_triangle || type == vtk_quad || type == vtk_pixel || type == vtk_polygon ||
                         type == vtk_triangle_strip || type == vtk_quadratic_triangle || type == vtk_biquadratic_triangle ||
                         type == vtk_quadratic_quad || type == vtk_biquadratic_quad;
    return point || line || (dimension == 3 && surface);
}

template <int Dim>
void read_points(CellSoup<Dim>& soup, const VtkGrid& grid, double planarity_tolerance) {
    geometry::Box<3> box;
    for (const Vector<3>& point : grid.points) {
        box.extend(point);
        soup.vertices.push_back(point.head<Dim>());
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
void append_cell(CellSoup<Dim>& soup, const VtkShape& shape, std::span<const std::int64_t> ids, std::size_t cell) {
    std::array<std::int32_t, max_cell_vertices> vertices{};
    const auto n = static_cast<std::size_t>(n_vertices(shape.shape));
    for (std::size_t i = 0; i < n; ++i)
        vertices[i] = static_cast<std::int32_t>(ids[static_cast<std::size_t>(shape.order[i])]);
    if (shape.shape == CellShape::prism) turn_wedge(soup, vertices);
    soup.cell_vertices.append({vertices.data(), n});
    soup.cell_shape.push_back(shape.shape);
    soup.cell_body.push_back(-1);
    soup.cell_label.push_back(static_cast<std::int64_t>(cell));
}

void check_points(const std::string& name, const VtkGrid& grid, std::size_t cell) {
    for (const std::int64_t id : grid.corners_of(cell))
        if (id < 0 || id >= std::ssize(grid.points))
            throw MeshError(name + ": cell " + std::to_string(cell) + " has the point " + std::to_string(id) +
                            ", the file has " + std::to_string(grid.points.size()) + ". Write the mesh again.");
}

/// Arrays of groups, whose names the soup gets.
template <int Dim>
std::vector<const VtkArray*> group_arrays(CellSoup<Dim>& soup, const VtkGrid& grid) {
    std::vector<const VtkArray*> arrays;
    for (const VtkArray& array : grid.cell_data)
        if (array.n_components == 1 && array.name.starts_with(group_prefix)) {
            arrays.push_back(&array);
            soup.group_names.push_back(array.name.substr(std::string_view(group_prefix).size()));
        }
    return arrays;
}

/// Whether a cell of lower dimension is a face of a group.
template <int Dim>
bool read_group_face(CellSoup<Dim>& soup, const VtkGrid& grid, const std::vector<const VtkArray*>& groups,
                     std::size_t cell) {
    bool is_face = false;
    for (std::size_t group = 0; group < groups.size(); ++group) {
        if (groups[group]->values[cell] == 0.0) continue;
        check_points(soup.name, grid, cell);
        typename CellSoup<Dim>::NamedFace face{{}, static_cast<std::int32_t>(group)};
        for (const std::int64_t id : grid.corners_of(cell)) face.vertices.push_back(static_cast<std::int32_t>(id));
        soup.named_faces.push_back(std::move(face));
        is_face = true;
    }
    return is_face;
}

/// Numbers of sets, as meshio and Gmsh call them after the format that a mesh came from; abut._meshio has the same list.
constexpr std::array<const char*, 7> number_arrays = {"gmsh:physical",   "cell_tags", "medit:ref",    "nastran:ref",
                                                      "avsucd:material", "su2:tag",   "CellEntityIds"};

/// The first of these arrays that has a whole number for each cell; null without one.
const VtkArray* set_numbers(const VtkGrid& grid) {
    const auto is_whole = [](double value) { return value == std::floor(value) && std::abs(value) <= 1e9; };
    for (const char* name : number_arrays)
        for (const VtkArray& array : grid.cell_data)
            if (array.name == name && array.n_components == 1 && std::ranges::all_of(array.values, is_whole)) return &array;
    return nullptr;
}

std::string name_of_set(std::int64_t number) { return std::string("set_") + std::to_string(number); }

/// As names_of_bodies, of numbers of sets: 0 is no set, and becomes -1.
std::vector<std::string> names_of_sets(std::vector<std::int64_t>& numbers) {
    std::vector<std::int64_t> distinct = numbers;
    sort_unique(distinct);
    std::erase(distinct, 0);
    for (std::int64_t& number : numbers)
        number = number == 0 ? -1 : std::lower_bound(distinct.begin(), distinct.end(), number) - distinct.begin();
    std::vector<std::string> names;
    for (const std::int64_t number : distinct) names.push_back(name_of_set(number));
    return names;
}

/// Corners of a face of cells of that dimension; 0: the type is none.
std::size_t n_face_corners(std::int64_t type, int dimension) {
    switch (type) {
        case vtk_line:
        case vtk_quadratic_edge:
            return dimension == 2 ? 2 : 0;
        case vtk_triangle:
        case vtk_quadratic_triangle:
        case vtk_biquadratic_triangle:
            return dimension == 3 ? 3 : 0;
        case vtk_quad:
        case vtk_quadratic_quad:
        case vtk_biquadratic_quad:
            return dimension == 3 ? 4 : 0;
        default:
            return 0;
    }
}

/// Whether a cell of lower dimension is a face of a set with a number, which becomes a group.
template <int Dim>
bool read_numbered_face(CellSoup<Dim>& soup, const VtkGrid& grid, const VtkArray& numbers, std::size_t cell) {
    const std::size_t n_corners = n_face_corners(grid.cell_types[cell], Dim);
    const auto ids = grid.corners_of(cell);
    if (n_corners == 0 || ids.size() < n_corners || numbers.values[cell] == 0.0) return false;
    check_points(soup.name, grid, cell);
    const std::string name = name_of_set(static_cast<std::int64_t>(numbers.values[cell]));
    const auto found = std::ranges::find(soup.group_names, name);
    const auto group = static_cast<std::int32_t>(found - soup.group_names.begin());
    if (found == soup.group_names.end()) soup.group_names.push_back(name);
    typename CellSoup<Dim>::NamedFace face{{}, group};
    for (const std::int64_t id : ids.first(n_corners)) face.vertices.push_back(static_cast<std::int32_t>(id));
    soup.named_faces.push_back(std::move(face));
    return true;
}

template <int Dim>
void read_cells(CellSoup<Dim>& soup, const VtkGrid& grid) {
    const auto values = body_values(soup.name, grid);
    const auto groups = group_arrays(soup, grid);
    const VtkArray* const numbers = values.empty() && groups.empty() ? set_numbers(grid) : nullptr;
    std::vector<std::int64_t> bodies;
    std::size_t n_curved = 0;
    for (std::size_t cell = 0; cell < grid.n_cells(); ++cell) {
        const std::int64_t type = grid.cell_types[cell];
        const auto shape = shape_of_vtk(type);
        if (has_lower_dimension(type, Dim)) {
            const bool is_face = numbers != nullptr ? read_numbered_face(soup, grid, *numbers, cell)
                                                    : read_group_face(soup, grid, groups, cell);
            if (!is_face) ++soup.n_ignored_elements;
            continue;
        }
        if (!shape || dimension(shape->shape) != Dim)
            throw MeshError(
                soup.name + ": cell " + std::to_string(cell) + " has the VTK cell type " + std::to_string(type) +
                ", which is no cell of a mesh of dimension " + std::to_string(Dim) +
                " here. Convert it to straight-sided triangles, quadrangles, tetrahedra, hexahedra, wedges or pyramids.");
        const auto ids = grid.corners_of(cell);
        const auto n_ids = std::ssize(ids);
        if (shape->is_curved ? n_ids < n_vertices(shape->shape) : n_ids != n_vertices(shape->shape))
            throw MeshError(soup.name + ": cell " + std::to_string(cell) + " has " + counted(n_ids, "point") + ", a " +
                            std::string(name(shape->shape)) + " has " + std::to_string(n_vertices(shape->shape)) +
                            ". Write the mesh again.");
        check_points(soup.name, grid, cell);
        append_cell(soup, *shape, ids, cell);
        n_curved += shape->is_curved;
        if (!values.empty()) bodies.push_back(values[cell]);
        if (numbers != nullptr) bodies.push_back(static_cast<std::int64_t>(numbers->values[cell]));
    }
    if (n_curved > 0) soup.warnings.push_back(about_order_2(n_curved));
    soup.body_names = numbers != nullptr ? names_of_sets(bodies) : names_of_bodies(bodies, grid);
    for (std::size_t cell = 0; cell < bodies.size(); ++cell) soup.cell_body[cell] = static_cast<std::int32_t>(bodies[cell]);
    name_connected_bodies(soup);
}

}  // namespace

template <int Dim>
Mesh<Dim> mesh_of(const VtkGrid& grid, const std::string& name, const MeshOptions& options) {
    CellSoup<Dim> soup;
    soup.name = name;
    read_points(soup, grid, options.planarity_tolerance);
    read_cells(soup, grid);
    return build_mesh(std::move(soup), options);
}

template <int Dim>
Mesh<Dim> read_vtu(const std::filesystem::path& path, const MeshOptions& options) {
    return mesh_of<Dim>(read_vtk_grid(path, VtkKind::unstructured_grid), path.string(), options);
}

template Mesh<3> mesh_of<3>(const VtkGrid&, const std::string&, const MeshOptions&);
template Mesh<2> read_vtu<2>(const std::filesystem::path&, const MeshOptions&);
template Mesh<3> read_vtu<3>(const std::filesystem::path&, const MeshOptions&);

}  // namespace abut::mesh
