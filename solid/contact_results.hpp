#pragma once
#include <cstdint>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::solid {

/// Stands for a face of an obstacle where boundary faces are named.
inline constexpr std::int32_t no_face = -1;

/// A contact of two faces, given as boundary faces; `no_face` is one of an obstacle.
template <int Dim>
struct TouchingPair {
    std::int32_t face_1;
    std::int32_t face_2;
    Vector<Dim> normal;  ///< from the body of face 1 into that of face 2
    double gap;          ///< [m]
};

/// Contact pressure [Pa] and smallest gap [m] of each boundary face, in the order of Mesh::boundary_faces; a face without an
/// admitted partner that shares area with it has pressure 0 and gap infinity.
struct ContactField {
    std::vector<double> pressure;
    std::vector<double> gap;
};

}  // namespace abut::solid
