#pragma once
// Private to the overlap sources; not installed.
#include "abut/geometry/overlap/overlap.hpp"

namespace abut::geometry {

/// Two edges lie on one line when both ends of one are within this part of the face size of the other's line.
inline constexpr double coincidence_tolerance = 1e-12;

/// A face is thin if its area is below this part of the square of its size: doubles leave of it fewer digits than six.
inline constexpr double thin_face = 1e-9;

/// z component of a x b [m^2].
inline double cross(const PlaneVector<3>& a, const PlaneVector<3>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Arithmetic that decided on a pair.
enum class Arithmetic { doubles, exact };

/// The reference: exact constructions, each result rounded once.
OverlapArea<2> exact_overlap_area(ProjectedFace<2> face_1, ProjectedFace<2> face_2, const PlaneVector<2>& shift);
OverlapArea<3> exact_overlap_area(ProjectedFace<3> face_1, ProjectedFace<3> face_2, const PlaneVector<3>& shift);

/// The side of the line from a to b on which c + shift lies: 1 left, 0 on it, -1 right. Exact, the shift is added without
/// rounding. Slow: to be asked where doubles cannot tell.
int exact_side(const PlaneVector<3>& a, const PlaneVector<3>& b, const PlaneVector<3>& c, const PlaneVector<3>& shift);

}  // namespace abut::geometry
