#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <optional>
#include <utility>

#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::solid {

template <int Dim>
class RankPart;

/// Second moments of a cell about its centroid, with density 1.
template <int Dim>
[[nodiscard]] Matrix<Dim> own_second_moment(const mesh::Mesh<Dim>& mesh, std::int32_t cell);

/// Positions of the masses of cells that give a body its moments of inertia: about the centroids of
/// the cells these lack those of the cells themselves. With K_c the second moments of cell c over its mass and X' from
/// the centre of mass,
///
///     Y'_c = X'_c + K_c (S X'_c + b),     sum m Y' = 0,     sum m Y' Y'^T = sum m (X' X'^T + K_c)
///
/// S is symmetric; points move by a part of the size of their own cell, little where cells are small. docs/method.md, Bodies
/// that turn.
template <int Dim>
struct CellPoints {
    Vector<Dim> centre;                ///< mean of X [m]
    double size;                       ///< radius of gyration of X [m]
    Matrix<Dim> slope;                 ///< S size^2 [-]
    Vector<Dim> shift;                 ///< b size [-]
    Matrix<Dim> inverse_x, inverse_y;  ///< of the second moments of X and of Y [1/(kg m^2)]

    [[nodiscard]] Vector<Dim> place(const mesh::Mesh<Dim>& mesh, std::int32_t cell) const;
};

/// Points of the cells [first, second) of a body that deforms, all of this density; nothing where they span no space,
/// or a point would leave its cell. `part` and `body` as BodyFrames takes and numbers them; a call of all ranks.
template <int Dim>
[[nodiscard]] std::optional<CellPoints<Dim>> find_cell_points(const mesh::Mesh<Dim>& mesh, std::int32_t body,
                                                              std::pair<std::int32_t, std::int32_t> cells, double density,
                                                              const RankPart<Dim>& part);

}  // namespace abut::solid
