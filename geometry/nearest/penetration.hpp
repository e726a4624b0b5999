#pragma once
#include "abut/geometry/health/face_soup.hpp"

namespace abut::geometry {

/// How deep two bodies with closed surfaces, whose normals look outwards, lie in each other [m]: the largest distance to
/// the surface of one from a point of the other that is inside of it; 0: no point is. Points are the corners of faces,
/// their middles, and the middles of edges as far as they lie in the box of the other body, so that the depth is a lower
/// bound. Where points times faces of the other body are more than 20 million every so many points are looked at.
/// Symmetric. An open surface has no inside. Corners must be in range and finite, faces flat and convex.
[[nodiscard]] double penetration_depth(const FaceSoup& surface_1, const FaceSoup& surface_2);

}  // namespace abut::geometry
