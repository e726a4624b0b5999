#pragma once
// Private to the overlap sources; not installed.
#include "abut/geometry/overlap.hpp"

namespace abut::geometry {

/// Two edges lie on one line when both ends of one are within this part of the face size of the other's line.
inline constexpr double coincidence_tolerance = 1e-12;

/// z component of a x b [m^2].
inline double cross(const PlaneVector<3>& a, const PlaneVector<3>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The reference: exact constructions, each result rounded once.
SharedArea<2> exact_shared_area(ProjectedFace<2> face_1, ProjectedFace<2> face_2, const PlaneVector<2>& shift);
SharedArea<3> exact_shared_area(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift);

/// Whether the interiors of two convex, counter-clockwise polygons meet, decided by exact predicates on the given
/// doubles. A polygon without area has no interior.
bool interiors_meet(std::span<const PlaneVector<3>> polygon_1, std::span<const PlaneVector<3>> polygon_2);

}  // namespace abut::geometry
