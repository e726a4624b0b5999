#pragma once
// Private to the layer.
#include <array>
#include <bit>
#include <cstdint>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Bit i: on the line of the edge of face 1 from corner i to the next one; bit 3 + i: the same of face 2.
using LineSet = std::uint8_t;
inline constexpr LineSet lines_of_face_1 = 0b000111;
inline constexpr LineSet lines_of_face_2 = 0b111000;

/// The lowest line of a set; -1: none.
[[nodiscard]] inline int first_line(int lines) { return lines == 0 ? -1 : std::countr_zero(static_cast<unsigned>(lines)); }

/// A corner of an overlap in the plane.
struct PlaneCorner {
    Vector<2> at;
    LineSet lines;
    double gap;
};

/// Throws std::logic_error.
[[noreturn]] void refuse_corner();

/// A polygon that is convex up to rounding, counter-clockwise. It begins as a triangle; each of at most four cuts adds one
/// corner at most.
struct PlanePolygon {
    static constexpr int capacity = 8;

    std::array<PlaneCorner, capacity> corner;
    int size = 0;

    void append(const PlaneCorner& added) {
        if (size == capacity) refuse_corner();
        corner[static_cast<std::size_t>(size++)] = added;
    }
};

/// Overlap of two triangles: corners 0 to 2 counter-clockwise, 3 to 5 clockwise. Gaps are not set. An edge of the overlap
/// that lies on an edge of both, within 1e-12 of its length, has the lines of both.
[[nodiscard]] PlanePolygon overlap_in_plane(const std::array<Vector<2>, 6>& corners);

/// Cuts away what has g >= 0; g is linear over the polygon.
void keep_negative_gap(PlanePolygon& polygon);

/// True if there is more to it than an edge or a point, up to rounding.
[[nodiscard]] bool has_area(const PlanePolygon& polygon, const std::array<Vector<2>, 6>& corners);

/// Point halfway between the nearest points of triangles that share nothing.
[[nodiscard]] Vector<2> halfway_between(const std::array<Vector<2>, 6>& corners);

}  // namespace abut::geometry
