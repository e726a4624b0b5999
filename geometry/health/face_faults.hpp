#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abut/geometry/health/face_soup.hpp"

namespace abut::geometry {

/// Why a face cannot be used in contact. A face has one fault: the first of this list that applies.
enum class FaceFault : std::uint8_t {
    none,
    index_out_of_range,  ///< names a vertex that is not there
    too_few_corners,     ///< fewer than 3
    too_many_corners,    ///< more than max_polygon_vertices
    not_finite,          ///< a coordinate is NaN or infinite
    too_large,           ///< a coordinate beyond max_coordinate
    repeated_corner,     ///< fewer than 3 corners at different positions
    zero_area,           ///< all corners on one line, decided exactly
    too_small,           ///< longest edge, or the area over it, below min_length: products of doubles vanish
    crossing,            ///< the polygon touches or crosses itself (a bow-tie), decided exactly in a coordinate plane
    non_convex,          ///< beyond what `contact` allows: 1e-10 of the face, and rounding
    duplicate,           ///< the corners of an earlier usable face, in the same sense of rotation
};
inline constexpr int n_face_faults = 12;

/// Up to here products of four lengths neither overflow nor vanish [m].
inline constexpr double max_coordinate = 1e75;
inline constexpr double min_length = 1e-75;

/// The fault of each face (n). Corners at exactly one position count as one vertex, whatever their index. A needle that is
/// not exactly collinear is usable, and so is a polygon that is not flat (to be cut into triangles) or a face that repeats
/// an earlier one the other way round. Never throws for bad faces; BadInput for bad offsets. n log n.
[[nodiscard]] std::vector<FaceFault> face_faults(const FaceSoup& soup);
/// Overload for a caller that has the result of merged_vertices(soup.vertices) already.
[[nodiscard]] std::vector<FaceFault> face_faults(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices);

/// The corners of a face as merged vertices, without those that repeat their predecessor. The face must name no vertex out
/// of range.
[[nodiscard]] std::vector<std::int32_t> distinct_corners(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices,
                                                         std::int32_t face);

/// The allowed distance of a corner outside the edges of its polygon, in units of sqrt(area), and the least that is
/// allowed from its plane:
/// face_tolerance, as contact::check has it.
[[nodiscard]] double shape_tolerance(std::span<const Vector<3>> corners);

/// "index_out_of_range", ...
[[nodiscard]] std::string_view name(FaceFault fault);
/// The fault of that face with its numbers, worded to follow the face's name: "names vertex 12, but there are 8".
[[nodiscard]] std::string describe(const FaceSoup& soup, std::int32_t face, FaceFault fault);

}  // namespace abut::geometry
