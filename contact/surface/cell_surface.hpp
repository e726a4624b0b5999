#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/contact/surface/nodal_faces.hpp"

namespace abut::contact {

/// Cells of a host, as it has them; read once.
struct HostCells {
    /// Corners of all cells, one cell after the other, in the order that VTK and most codes have: three or four (2D), four
    /// (tetrahedra), five (pyramids), six (prisms) or eight (hexahedra)
    std::span<const std::int32_t> nodes;
    std::span<const std::int32_t> offsets;    ///< (n_cells + 1), into `nodes`
    std::span<const std::int32_t> body = {};  ///< (n_cells), from 0 on; empty: all are of body 0
};

/// Boundary faces in the words of NodalFaces, in the order of their cells and of the faces within each. Stiffnesses are left
/// to the host.
template <int Dim>
struct CellSurface : NodalFaceArrays<Dim> {
    std::vector<std::int32_t> cell;  ///< (n_faces) the cell behind each
};

/// The faces that one cell alone has, turned outwards whatever the sense of the cells, and half the height of the cell
/// behind each: of simplices Dim V/(2 A), of others V/(2 A), with the volume V of the cell and the area A of the face.
/// Throws BadInput naming the cell: an index out of range, a number of corners that no cell has, a corner that is not
/// finite, a cell without volume, three cells at one face, cells of two bodies at one face.
template <int Dim>
[[nodiscard]] CellSurface<Dim> surface_of(PointsView<Dim> rest, const HostCells& cells);

}  // namespace abut::contact
