#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "abut/base/vector.hpp"
#include "abut/solid/boundary/boundary_face.hpp"

namespace abut::solid {

/// Where two faces of a bond lie on each other at rest: the middle of their overlap, a point of both sides. On several ranks all
/// know all places.
template <int Dim>
struct BondPlace {
    std::size_t bond;
    std::array<BoundaryFace, 2> faces;  ///< of the mesh of all bodies; `no_face`: it is on other ranks alone
    /// Of the faces among all boundary faces of the bodies that deform, of all ranks
    std::array<std::size_t, 2> numbers;
    std::array<std::int32_t, 2> bodies;  ///< in the mesh
    double area;                         ///< of the overlap [m^(Dim-1)]
    Vector<Dim> position;                ///< [m]
    Vector<Dim> normal;                  ///< from the first face into the second
};

}  // namespace abut::solid
