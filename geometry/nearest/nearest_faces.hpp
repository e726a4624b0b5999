#pragma once
#include "abut/geometry/face_tree.hpp"
#include "abut/geometry/health/face_soup.hpp"

namespace abut::geometry {

/// The nearest faces of two surfaces, as `nearest_faces` of their trees, which are made of those faces alone that may be:
/// not farther from the other surface than two vertices that are near each other. None if one has no face. Corners must
/// be in range and finite, faces flat and convex, and have three corners at least.
[[nodiscard]] NearestFaces nearest_faces(const FaceSoup& surface_1, const FaceSoup& surface_2);

}  // namespace abut::geometry
