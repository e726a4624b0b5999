#pragma once
#include <array>

#include "abut/base/vector.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::geometry {

/// The part of the outline of a face that is nearest to the other face of its pair, seen along n.
struct OutlinePart {
    int corner = -1;  ///< of the face; -1: between two corners
    int edge = -1;    ///< 3D, where it is no corner: the edge from this corner to the next one
    /// 3D, of a corner: how far the direction to the other face is turned, in the plane normal to n, out of the face
    /// past the edge to the next corner, and past that to the previous one [rad]; 0 both: it does not leave the face
    double past_next = 0.0;
    double past_previous = 0.0;
};

/// Points where the overlap of a pair that shares nothing would begin: on face 1 and on face 2. n_1 . n_2 must be at most
/// 0.3. Where faces touch the direction is that to the middle of the other face.
template <int Dim>
[[nodiscard]] std::array<OutlinePart, 2> pair_approach(const PairCorners<Dim>& corners, const PairLaw<Dim>& law);

}  // namespace abut::geometry
