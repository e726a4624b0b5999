#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/part.hpp"
#include "abut/solid/kinematics/kinematics.hpp"

namespace abut::solid {

// How the mesh of a solid is shared out to several ranks. `kinematics`: one per body; none: all are `small`. docs/ranks.md.

/// How many layers of neighbours a solid needs around the cells of a rank. Free faces of bodies of Kinematics::finite
/// depend on the stress behind them, one layer farther. The solid checks them where it is made: stencils near a slot
/// may need more.
[[nodiscard]] int copy_layers(std::span<const Kinematics> kinematics);

/// The part of a rank, for its solid: with these layers, and the whole of all rigid bodies. `owner` says whose each cell is
/// (n_cells); the points of a rigid body belong to that of its first cell. `more_layers` come on top of `copy_layers`.
/// Throws as mesh::part_of, and BadInput for another number of kinematics than of bodies.
template <int Dim>
[[nodiscard]] mesh::MeshPart<Dim> part_of(const mesh::Mesh<Dim>& whole, std::span<const int> owner, int rank,
                                          std::span<const Kinematics> kinematics, int more_layers = 0);

/// The points of a solid that a part has, its own and copies.
struct PartPoints {
    std::int32_t n_points = 0;         ///< of all ranks
    std::vector<std::int32_t> number;  ///< among these, increasing (n)
    std::vector<int> owner;            ///< the rank that owns it (n)
};
/// The points of a part that `part_of` has made, as ranks::shared_points takes them. Throws BadInput for a part that
/// does not have a rigid body.
template <int Dim>
[[nodiscard]] PartPoints points_of(const mesh::MeshPart<Dim>& part, std::span<const Kinematics> kinematics);

/// How much each cell of the whole mesh weighs where it is shared out (n_cells, or none: all the same), from weights of the
/// points (n_points, or none: all the same). Cells of rigid bodies weigh nothing, since they are not evaluated; all
/// weigh the same where all bodies are rigid. Throws BadInput for another number of weights.
template <int Dim>
[[nodiscard]] std::vector<double> cell_weights(const mesh::Mesh<Dim>& whole, std::span<const Kinematics> kinematics,
                                               std::span<const double> of_points);

}  // namespace abut::solid
