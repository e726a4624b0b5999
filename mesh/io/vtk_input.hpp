#pragma once
// Private to the layer; not installed.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Numbers of VTK's cell types (vtkCellType.h).
enum VtkCell : std::uint8_t {
    vtk_empty_cell,
    vtk_vertex,
    vtk_poly_vertex,
    vtk_line,
    vtk_poly_line,
    vtk_triangle,
    vtk_triangle_strip,
    vtk_polygon,
    vtk_pixel,
    vtk_quad,
    vtk_tetra,
    vtk_voxel,
    vtk_hexahedron,
    vtk_wedge,
    vtk_pyramid,
    vtk_quadratic_edge = 21,
    vtk_quadratic_triangle,
    vtk_quadratic_quad,
    vtk_quadratic_tetra,
    vtk_quadratic_hexahedron,
    vtk_quadratic_wedge,
    vtk_quadratic_pyramid,
    vtk_biquadratic_quad,
    vtk_triquadratic_hexahedron,
    vtk_biquadratic_quadratic_wedge = 32,
    vtk_biquadratic_triangle = 34
};

/// The array that says which faces are in a group, and the number of a body in the array "body", are called so, with
/// the name of the group or body behind it.
inline constexpr const char* group_prefix = "group: ";
inline constexpr const char* body_prefix = "body: ";

struct VtkArray {
    std::string name;
    std::size_t n_components = 1;
    std::vector<double> values;  ///< (n, n_components)
};

/// Contents of a .vtu or .vtp file, all pieces joined. Cells of poly data are vertices, lines, polygons and strips, in this
/// order, of the types vtk_poly_vertex, vtk_poly_line, vtk_polygon and vtk_triangle_strip.
struct VtkGrid {
    std::vector<Vector<3>> points;
    std::vector<std::int64_t> cell_types;         ///< as they stand in the file (n_cells)
    std::vector<std::int64_t> cell_ends;          ///< end of the corners of each cell, never decreasing (n_cells)
    std::vector<std::int64_t> corners;            ///< point indices as they stand in the file, which may be out of range
    std::vector<VtkArray> point_data, cell_data;  ///< one tuple for each point or cell
    std::vector<VtkArray> body_numbers;           ///< by the names of bodies: their value in the array "body"

    [[nodiscard]] std::size_t n_cells() const { return cell_types.size(); }
    [[nodiscard]] std::span<const std::int64_t> corners_of(std::size_t cell) const;
};

enum class VtkKind { unstructured_grid, poly_data };

/// Reads ascii, binary and appended arrays (base64 and raw), compressed by zlib or not, in either order of bytes, with
/// headers of 32 and 64 bits, of all types of numbers. Of arrays of several time steps the first is taken.
///
/// Memory is taken for what a file holds, not for what it promises. Numbers of points, cells, components and bytes are
/// weighed against the size of the file first: a value takes 2 bytes as text and those of its type in binary, and zlib
/// shrinks that by 1,032 at most.
///
/// Throws MeshError naming the path, with the line where there is one: missing, empty, truncated, of another kind, damaged,
/// compressed by another method, more than 2^31 - 1 points.
[[nodiscard]] VtkGrid read_vtk_grid(const std::filesystem::path& path, VtkKind kind);

/// Value of the array "body" in each cell; empty without that array. Throws MeshError for a value that is no whole number.
[[nodiscard]] std::vector<std::int64_t> body_values(const std::string& name, const VtkGrid& grid);

/// Replaces values of the array "body" by indices into the names that are returned, in increasing order of the values:
/// "ball" where the file has that value as its number "body: ball", else "body_<value>".
[[nodiscard]] std::vector<std::string> names_of_bodies(std::vector<std::int64_t>& values, const VtkGrid& grid);

/// The cells of dimension Dim; errors and the rest as told of `read_vtu`.
template <int Dim>
[[nodiscard]] Mesh<Dim> mesh_of(const VtkGrid& grid, const std::string& name, const MeshOptions& options);

}  // namespace abut::mesh
