#pragma once
// Private to the layer; not installed.
#include <array>
#include <cstdint>
#include <optional>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// A type of elements of Gmsh's file formats.
struct MshType {
    std::int32_t number;  ///< Gmsh's
    std::int32_t dimension;
    std::int32_t order;     ///< of its shape functions
    std::size_t n_corners;  ///< its first nodes
    std::size_t n_nodes;
    const char* name;
    std::optional<CellShape> shape;  ///< of its corners, where it can be a cell
};

/// Gmsh's types 1 to 31: all of orders 1 and 2, and those of higher orders up to tetrahedra of order 5.
inline constexpr std::array<MshType, 31> msh_types = {{{1, 1, 1, 2, 2, "line", {}},
                                                       {2, 2, 1, 3, 3, "triangle", CellShape::triangle},
                                                       {3, 2, 1, 4, 4, "quadrangle", CellShape::quadrangle},
                                                       {4, 3, 1, 4, 4, "tetrahedron", CellShape::tetrahedron},
                                                       {5, 3, 1, 8, 8, "hexahedron", CellShape::hexahedron},
                                                       {6, 3, 1, 6, 6, "prism", CellShape::prism},
                                                       {7, 3, 1, 5, 5, "pyramid", CellShape::pyramid},
                                                       {8, 1, 2, 2, 3, "line", {}},
                                                       {9, 2, 2, 3, 6, "triangle", CellShape::triangle},
                                                       {10, 2, 2, 4, 9, "quadrangle", CellShape::quadrangle},
                                                       {11, 3, 2, 4, 10, "tetrahedron", CellShape::tetrahedron},
                                                       {12, 3, 2, 8, 27, "hexahedron", CellShape::hexahedron},
                                                       {13, 3, 2, 6, 18, "prism", CellShape::prism},
                                                       {14, 3, 2, 5, 14, "pyramid", CellShape::pyramid},
                                                       {15, 0, 1, 1, 1, "point", {}},
                                                       {16, 2, 2, 4, 8, "quadrangle", CellShape::quadrangle},
                                                       {17, 3, 2, 8, 20, "hexahedron", CellShape::hexahedron},
                                                       {18, 3, 2, 6, 15, "prism", CellShape::prism},
                                                       {19, 3, 2, 5, 13, "pyramid", CellShape::pyramid},
                                                       {20, 2, 3, 3, 9, "triangle", CellShape::triangle},
                                                       {21, 2, 3, 3, 10, "triangle", CellShape::triangle},
                                                       {22, 2, 4, 3, 12, "triangle", CellShape::triangle},
                                                       {23, 2, 4, 3, 15, "triangle", CellShape::triangle},
                                                       {24, 2, 5, 3, 15, "triangle", CellShape::triangle},
                                                       {25, 2, 5, 3, 21, "triangle", CellShape::triangle},
                                                       {26, 1, 3, 2, 4, "line", {}},
                                                       {27, 1, 4, 2, 5, "line", {}},
                                                       {28, 1, 5, 2, 6, "line", {}},
                                                       {29, 3, 3, 4, 20, "tetrahedron", CellShape::tetrahedron},
                                                       {30, 3, 4, 4, 35, "tetrahedron", CellShape::tetrahedron},
                                                       {31, 3, 5, 4, 56, "tetrahedron", CellShape::tetrahedron}}};

/// Nothing for a number that is none of these.
[[nodiscard]] constexpr const MshType* msh_type(std::int64_t number) {
    return number < 1 || number > 31 ? nullptr : &msh_types[static_cast<std::size_t>(number) - 1];
}

}  // namespace abut::mesh
