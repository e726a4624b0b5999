#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "abut/base/vector.hpp"
#include "abut/solid/boundary/boundary_face.hpp"

namespace abut::solid {

/// Position where two faces of a bond lie on each other at rest: the middle of their overlap, a point of both sides. On
/// several ranks all know all places.
template <int Dim>
struct BondPlace {
    std::size_t bond;
    std::array<BoundaryFace, 2> faces;  ///< of the mesh of all bodies; `no_face`: it is on other ranks alone
    /// Numbers of the faces among all boundary faces of the bodies that deform, of all ranks
    std::array<std::size_t, 2> numbers;
    std::array<std::int32_t, 2> bodies;  ///< in the mesh
    std::array<double, 2> measures;      ///< of the faces [m^(Dim-1)]
    double area;                         ///< of the overlap [m^(Dim-1)]
    Vector<Dim> position;                ///< [m]
    Vector<Dim> normal;                  ///< from the first face into the second
    double strength;                     ///< Bond::strength, or what was drawn from its Weibull distribution [Pa]
};

/// How much of the two sides of a bond holds on to each other at rest.
struct BondCoverage {
    double area = 0.0;      ///< of its places [m^(Dim-1)]
    double opposite = 0.0;  ///< where faces of both sides lie opposite each other, not farther than the larger one is wide
    double smaller_side = 0.0;  ///< of the side that has less: of a group all of it, of a body what looks at the other side
    double largest_gap = 0.0;   ///< of a place, apart or inside each other, >= 0 [m]
    /// Least E G/strength^2 of a place over the size of the larger cell beside it [-]; infinity where the bond takes no
    /// fracture energy
    double cohesive_length = std::numeric_limits<double>::infinity();

    /// Bonded area over what was asked for, which is where the sides lie opposite each other [-].
    [[nodiscard]] double share() const { return opposite > 0.0 ? area / opposite : 1.0; }
    /// Bonded area over that of the smaller side, at most 1 [-]
    [[nodiscard]] double share_of_side() const { return smaller_side > area ? area / smaller_side : 1.0; }
};

}  // namespace abut::solid
