#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

inline constexpr int n_cell_shapes = 6;
inline constexpr int max_face_vertices = 4;
inline constexpr int max_cell_vertices = 8;
/// So that every count of vertices and faces of cells fits into 32 bits.
inline constexpr std::int32_t max_cells = std::numeric_limits<std::int32_t>::max() / max_cell_vertices;

/// "triangle", "quadrangle", ...
[[nodiscard]] std::string_view name(CellShape shape);
/// 2 for triangle and quadrangle, else 3.
[[nodiscard]] int dimension(CellShape shape);
[[nodiscard]] int n_vertices(CellShape shape);
[[nodiscard]] int n_faces(CellShape shape);

/// The cell's own vertices (0 .. n_vertices - 1) that make its face number `face`: two in the cell's sense of rotation (2D),
/// or three or four counter-clockwise seen from outside (3D). A row of Mesh::cell_faces is in the order of these faces.
///
/// triangle, quadrangle: edge i joins vertex i and i + 1.   tetrahedron: 013 123 203 021.
/// hexahedron: 0473 1265 0154 3762 0321 4567.   prism: 021 345 0143 1254 2035.   pyramid: 0321 014 124 234 304.
[[nodiscard]] std::span<const std::int8_t> face_vertices(CellShape shape, int face);

}  // namespace abut::mesh
