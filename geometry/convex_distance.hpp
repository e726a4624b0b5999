#pragma once
#include <span>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Distance of the convex hulls of two sets of points [m], 0 where they touch or overlap. It is never too large, and right
/// to 1e-6 of the size of the bodies: measured along the best of the directions that GJK proposes.
/// Throws BadInput if a set is empty or a coordinate is not finite.
template <int Dim>
[[nodiscard]] double convex_distance(std::span<const Vector<Dim>> body_1, std::span<const Vector<Dim>> body_2);

}  // namespace abut::geometry
