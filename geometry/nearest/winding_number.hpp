#pragma once
#include "abut/base/vector.hpp"
#include "abut/geometry/health/face_soup.hpp"

namespace abut::geometry {

/// How often a surface winds around a point: the sum of the solid angles of its faces over 4 pi [-], each from its
/// outer side below 0. A closed surface whose normals look outwards has 1 inside and 0 outside, up to rounding; one
/// turned inside out has -1 inside; an open one has any number. Corners must be in range and finite, faces flat; on the
/// surface itself it means nothing.
[[nodiscard]] double winding_number(const FaceSoup& surface, const Vector<3>& point);

/// Whether a point is inside of a closed surface whose normals look outwards; false of an open one, within 1e-6.
[[nodiscard]] bool is_inside(const FaceSoup& surface, const Vector<3>& point);

}  // namespace abut::geometry
