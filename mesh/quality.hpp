#pragma once
#include <array>
#include <cstdint>

#include "abut/base/error.hpp"
#include "abut/mesh/cell_shape.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// A mesh or a mesh file that cannot be used. The message names the mesh, the cell or face as numbered in the input, the
/// value, the limit, and what to do.
struct MeshError : BadInput {
    using BadInput::BadInput;
};

/// Numbers to judge a mesh by. The cells are indices in the mesh.
struct MeshQuality {
    double smallest_measure;  ///< min |c| [m^Dim]
    double largest_measure;   ///< max |c| [m^Dim]
    std::int32_t smallest_cell;
    double worst_aspect_ratio;  ///< longest edge / inradius over that of the shape with equal edges: 1 is ideal [-]
    std::int32_t worst_cell;
    double smallest_inradius;                            ///< [m]; the inradius of a cell is taken as Dim |c| / sum |f|
    std::array<std::int32_t, n_cell_shapes> n_cells_of;  ///< by CellShape
    BuildReport report;                                  ///< what was dropped, ignored or cut on the way in
};

/// The numbers of a mesh; of equally small or equally bad cells the first is named.
template <int Dim>
[[nodiscard]] MeshQuality quality(const Mesh<Dim>& mesh);

}  // namespace abut::mesh
