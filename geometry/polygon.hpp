#pragma once
#include <span>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// The vertices of a face in order. 3D: a polygon of 3 vertices or more, in space. 2D: the two ends of a segment.
template <int Dim>
using FaceVertices = std::span<const Vector<Dim>>;

/// |f| [m^(Dim-1)], >= 0. 3D: the area of the polygon's projection along its Newell normal. 0 for a degenerate face.
template <int Dim>
[[nodiscard]] double face_measure(FaceVertices<Dim> face);

/// Barycentre of the face [m]. A degenerate face (no measure) gives the mean of its vertices.
template <int Dim>
[[nodiscard]] Vector<Dim> face_centroid(FaceVertices<Dim> face);

/// The allowed deviation of corners and measures of a face, over its size [-]: 1e-10, plus the rounding of coordinates far
/// from the origin. `measure` is face_measure, > 0; the size is its square root in 3D, and the length of the segment in 2D.
template <int Dim>
[[nodiscard]] double face_tolerance(const Vector<Dim>& centroid, double measure);

/// Unit normal; the zero vector for a degenerate face. 3D: Newell's normal, the vertices run counter-clockwise about it.
/// 2D: b - a turned by -90 degrees, so that a body whose boundary runs counter-clockwise has outward normals.
template <int Dim>
[[nodiscard]] Vector<Dim> face_normal(FaceVertices<Dim> face);

/// Largest distance [m] of a vertex from the plane through the centroid and orthogonal to the normal; 0 for triangles,
/// segments and degenerate faces, up to rounding.
template <int Dim>
[[nodiscard]] double planarity_deviation(FaceVertices<Dim> face);

/// True if no vertex of the polygon lies more than `tolerance` [m] on the outer side of the line of any edge. Straight
/// corners and repeated vertices are convex. Segments and degenerate faces are, and a polygon that runs around twice.
template <int Dim>
[[nodiscard]] bool is_convex(FaceVertices<Dim> face, double tolerance);

}  // namespace abut::geometry
