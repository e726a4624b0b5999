#pragma once
// Private to the sources of this layer.
#include <vector>

#include "abut/solid/body/bodies.hpp"
#include "abut/solid/boundary/bond_places.hpp"
#include "abut/solid/part/rank_part.hpp"

namespace abut::solid {

template <int Dim>
struct FoundBonds {
    /// Positions of all bonds, each in the order of its first faces, then of its second ones.
    std::vector<BondPlace<Dim>> places;
    std::vector<BondCoverage> coverage;  ///< of each bond
    /// Boundary faces here of bodies that deform, increasing, which are small, not of triangles or tetrahedra, and lie
    /// on one face alone, all of it, without being able to part from it.
    std::vector<BoundaryFace> joined;
    std::vector<BoundaryFace> glued;  ///< those that hold grains in one frame (Bodies::have_one_frame), increasing
};

/// Throws BadInput for sides that do not exist, are the same or do not lie on each other anywhere, and for a strength
/// that is not > 0 or a fracture energy without one. A call of all ranks.
template <int Dim>
[[nodiscard]] FoundBonds<Dim> find_bond_places(const Bodies<Dim>& bodies, const RankPart<Dim>& part);

}  // namespace abut::solid
