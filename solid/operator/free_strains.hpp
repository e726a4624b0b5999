#pragma once
// Private to the sources of this layer.
#include <Eigen/Core>
#include <span>

#include "abut/solid/operator/free_face_of_cell.hpp"

namespace abut::solid {

/// Stiffness below which a combination of free faces has none, over the largest eigenvalue [-].
inline constexpr double no_stiffness = 1e-10;

/// Orthonormal combinations of z = |f|/|c| û_f of a cell's free faces that balance the stress of the cell, one per
/// column (n_faces Dim, n_kept). docs/method.md, Space.
///
/// The strain of a combination is the sum of sym(z (x) n_f). Those are kept whose strain is more than `least_strain` of
/// the largest one; every other is left to the affine extrapolation: rotations, which strain nothing, and what strains
/// only because two normals differ by the chord of a curve, or a normal and a support by little from a right angle. To
/// balance such a pair takes displacements that are as large as the angle is small, and leaves the cell without stress.
/// No material and no size enters. At the tip of a wedge of less than 60 degrees all that strains is kept.
struct BalancingCombinations {
    Eigen::MatrixXd of_faces;
    bool leaves_strains = false;  ///< whether another combination strains the cell, too
};
template <int Dim>
[[nodiscard]] BalancingCombinations balancing_combinations(std::span<const FreeFaceOfCell<Dim>> faces);

/// Whether two free faces of a cell look away from each other by more than 120 degrees: the cell is the tip of a wedge,
/// which really bears nothing, or all that there is between them.
template <int Dim>
[[nodiscard]] bool is_tip(std::span<const FreeFaceOfCell<Dim>> faces);

/// With anything between 0.1 and 0.45 quarter models of rings are the same; below 0.05 cells at their holes bear nothing.
inline constexpr double least_strain = 0.25;

}  // namespace abut::solid
