#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "abut/geometry/polygon.hpp"

namespace abut::geometry {

/// Three corners of a polygon by their index in it, in its sense of rotation.
using LocalTriangle = std::array<std::int32_t, 3>;

/// Cuts a polygon that is convex seen along its normal, flat or not, into n - 2 triangles without a new vertex: of all ways
/// that with the best worst triangle (twice the area over the square of the longest edge), so that straight corners give no
/// flat triangle where that can be avoided. Of equal ways always the same one. 3 to max_polygon_vertices corners; fewer give
/// none, more throw BadInput. n^3.
[[nodiscard]] std::vector<LocalTriangle> cut_into_triangles(FaceVertices<3> polygon);

}  // namespace abut::geometry
