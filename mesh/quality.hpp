#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

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

template <int Dim>
[[nodiscard]] MeshQuality quality(const Mesh<Dim>& mesh);

/// "(3, 17, 28)": vertices by the number they had in the input.
[[nodiscard]] std::string vertex_list(std::span<const std::int32_t> vertices, const std::vector<std::int64_t>& labels);

/// The checks of `build_mesh` that need no geometry: sizes of the arrays, shapes of dimension Dim, indices in range, finite
/// coordinates, no vertex twice in a cell, no vertex in two bodies, at least one cell in all and in each body, distinct
/// names of bodies and of groups. Throws MeshError.
template <int Dim>
void check_soup(const CellSoup<Dim>& soup);

/// The checks of `build_mesh` on cells: measure above 1e-12 (diameter)^Dim; no cell inside out.
template <int Dim>
void check_cells(const CellSoup<Dim>& soup, std::span<const double> cell_measure);

/// The checks of `build_mesh` on faces: measure above 1e-12 (diameter of the cell)^(Dim-1), convex, and the centroid of each
/// cell on the inner side of each of its faces. Whether they are plane has been seen to before (mesh/split.hpp).
template <int Dim>
void check_faces(const Mesh<Dim>& mesh);

/// Throws MeshError if two of the names are the same. `what` is "bodies" or "boundary groups".
void check_distinct(const std::string& mesh_name, const std::string& what, std::vector<std::string> names);

}  // namespace abut::mesh
