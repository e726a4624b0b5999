#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Methods to compute the area that two faces share.
enum class AreaMethod {
    fast,   ///< double arithmetic; whether the faces overlap at all is decided exactly
    exact,  ///< CGAL exact constructions, rounded to double at the end: the reference
};

/// A face seen along the normal of a pair: its vertices in the plane orthogonal to that normal. 3D: a convex polygon,
/// counter-clockwise, 3 to `max_polygon_vertices` vertices. 2D: a segment, two numbers in increasing order.
template <int Dim>
using ProjectedFace = std::span<const PlaneVector<Dim>>;

inline constexpr int max_polygon_vertices = 16;

/// The patch two projected faces share, the second one shifted by s.
template <int Dim>
struct OverlapArea {
    double area = 0.0;                                          ///< A_12 [m^(Dim-1)], 0 when they only touch or are apart
    PlaneVector<Dim> area_gradient = PlaneVector<Dim>::Zero();  ///< dA/ds [m^(Dim-2)]
};

/// A_12(s) and its derivative. Whether A_12 > 0 is decided exactly, on the given coordinates and the shift as they stand:
/// nothing is rounded before, so both methods always agree on it, and so do the faces swapped with the shift reversed.
/// The area is then rounded to double, to no less than the smallest normal one. dA/ds is the sum over the edges of face 2
/// inside face 1 of (length) (outward in-plane normal); an edge of 2 that lies on an edge of 1 (within 1e-12 of the face
/// size, matching meshes) counts half, and not at all if it runs the other way: such faces lie side by side. Zero area
/// gives a zero derivative. docs/method.md, Contact. `exact` takes the half only where the edges are exactly collinear: on
/// meshes that match up to rounding the derivatives of the two methods differ. Repeated vertices and straight corners are
/// allowed; a face without area (a point, a line) shares none. Throws BadInput for a coordinate or a shift that is not
/// finite.
template <int Dim>
[[nodiscard]] OverlapArea<Dim> overlap_area(ProjectedFace<Dim> face_1, ProjectedFace<Dim> face_2,
                                            const PlaneVector<Dim>& shift, AreaMethod method = AreaMethod::fast);

/// The patch itself: its corners, counter-clockwise (3D; convex up to rounding, with corners that may repeat), or its two
/// ends in increasing order (2D). Empty where the faces share no area, which is decided exactly; the corners are rounded.
/// Throws BadInput for a coordinate that is not finite.
template <int Dim>
[[nodiscard]] std::vector<PlaneVector<Dim>> overlap_polygon(ProjectedFace<Dim> face_1, ProjectedFace<Dim> face_2);

/// Two triangles to be compared as `overlap_area` does, each counter-clockwise.
struct TrianglePair {
    std::array<PlaneVector<3>, 3> face_1, face_2;
    PlaneVector<3> shift;  ///< of face 2
};

/// Number of pairs by the arithmetic that decided on them; the three add up to all pairs.
struct DecisionCounts {
    std::int64_t by_doubles = 0;           ///< many at once: signs are sure with doubles, or with twice their digits
    std::int64_t by_scalar_path = 0;       ///< one by one, doubles still enough
    std::int64_t by_exact_arithmetic = 0;  ///< one by one, numbers of any length asked

    DecisionCounts& operator+=(const DecisionCounts& other);
    [[nodiscard]] std::int64_t total() const { return by_doubles + by_scalar_path + by_exact_arithmetic; }
};

/// `overlap_area` of many pairs of triangles by the method `fast`, several times quicker: pairs[i] gives areas[i]. The same
/// decisions, and the same numbers up to rounding. What a pair gives depends on that pair alone. Throws
/// BadInput if the sizes differ, and for a coordinate or a shift that is not finite; part of `areas` may be written then.
DecisionCounts overlap_areas(std::span<const TrianglePair> pairs, std::span<OverlapArea<3>> areas);

/// Appends to `events` the parameters tau in (0, 1) at which A_12 may change its formula while the shift goes straight from
/// `shift_0` to `shift_1`: a vertex of one face crosses an edge of the other. Unsorted, with duplicates possible. Between
/// two neighbouring events A_12 is a polynomial of degree Dim - 1 in tau. An edge parallel to the motion gives none.
template <int Dim>
void append_overlap_events(ProjectedFace<Dim> face_1, ProjectedFace<Dim> face_2, const PlaneVector<Dim>& shift_0,
                           const PlaneVector<Dim>& shift_1, std::vector<double>& events);

}  // namespace abut::geometry
