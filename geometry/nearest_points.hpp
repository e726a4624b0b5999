#pragma once
#include <limits>
#include <span>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// A point of each of two bodies, and their distance.
struct NearestPoints {
    Vector<3> point_1 = Vector<3>::Zero(), point_2 = Vector<3>::Zero();  ///< [m]
    double distance = std::numeric_limits<double>::infinity();           ///< [m]
};

/// Points where two flat convex polygons are nearest, exact up to rounding in the size of both and their distance;
/// where they touch or cross, a point of both and the distance 0. They have three corners at least, in order; some may
/// coincide.
[[nodiscard]] NearestPoints nearest_points(std::span<const Vector<3>> face_1, std::span<const Vector<3>> face_2);

}  // namespace abut::geometry
