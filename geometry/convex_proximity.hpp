#pragma once
#include <span>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Relative position of two convex bodies. Law: moving body 2 by `depth` along `direction` parts them, and no point of 1 is
/// nearer than `distance` to a point of 2. At most one of the two is positive; both are 0 when the bodies touch.
template <int Dim>
struct ConvexProximity {
    double distance;        ///< [m]
    double depth;           ///< penetration [m]
    Vector<Dim> direction;  ///< from body 1 towards body 2, unit length
};

/// Distance or penetration depth of the convex hulls of two sets of points, for reports before a run; not for a force.
/// The result is measured along `direction`, the best of those proposed by GJK (distance) and by libccd's EPA and MPR
/// (depth). So it is always on the safe side: where the iterations fail or stop at their limit (bodies that just touch, flat
/// bodies) the distance is a lower and the depth an upper bound. Relative accuracy otherwise: 1e-6 of the size of the
/// bodies. With no more than 16 points in all (two hexahedra) all axes that can be the best are tried: the depth is then
/// exact up to rounding.
/// Throws BadInput if a set is empty or a coordinate is not finite.
/// Where libccd is not there (ABUT_LAYERS=contact) there is none; `convex_distance` is there always.
template <int Dim>
[[nodiscard]] ConvexProximity<Dim> convex_proximity(std::span<const Vector<Dim>> body_1,
                                                    std::span<const Vector<Dim>> body_2);

}  // namespace abut::geometry
