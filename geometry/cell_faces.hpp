#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace abut::geometry {

/// Corners of the faces of a cell: in 2D in the sense of the cell, in 3D counter-clockwise seen from outside.
struct CellFaces {
    int dimension;
    int n_corners;
    int n_faces;
    std::array<std::array<std::int8_t, 4>, 6> corners;  ///< -1 fills up

    [[nodiscard]] std::span<const std::int8_t> face(int face) const {
        const auto& of_face = corners[static_cast<std::size_t>(face)];
        std::size_t count = 2;
        while (count < of_face.size() && of_face[count] >= 0) ++count;
        return {of_face.data(), count};
    }
};

/// Triangle, quadrangle, tetrahedron, hexahedron, prism, pyramid, with their corners in the order that VTK has.
inline constexpr std::array<CellFaces, 6> cell_faces = {{
    {2, 3, 3, {{{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 0, -1, -1}}}},
    {2, 4, 4, {{{0, 1, -1, -1}, {1, 2, -1, -1}, {2, 3, -1, -1}, {3, 0, -1, -1}}}},
    {3, 4, 4, {{{0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}, {0, 2, 1, -1}}}},
    {3, 8, 6, {{{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}}},
    {3, 6, 5, {{{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}},
    {3, 5, 5, {{{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}}},
}};

}  // namespace abut::geometry
