#pragma once
// Private to the layer.
#include <cstdint>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// Rounding of cosines [-]: an edge or a corner of just the limiting angle is not beyond it.
inline constexpr double cosine_rounding = 1e-9;

/// Ridge between two faces of a body: an edge in 3D, a corner in 2D.
struct Ridge {
    std::int32_t face_1;
    std::int32_t face_2;
    std::int32_t vertex_1;  ///< its ends; in 2D the same vertex twice
    std::int32_t vertex_2;
};

/// Ridges that exactly two faces of a body share, with ends at exactly the same positions; in a fixed order. n log n.
template <int Dim>
[[nodiscard]] std::vector<Ridge> ridges(const SurfaceView<Dim>& surface);

/// Whether the body lies on the inner side of both faces.
template <int Dim>
[[nodiscard]] bool is_convex(const SurfaceView<Dim>& surface, const Ridge& ridge) {
    const Vector<Dim> from_1_to_2 = surface.centroid[ridge.face_2] - surface.centroid[ridge.face_1];
    return from_1_to_2.dot(surface.normal[ridge.face_1] - surface.normal[ridge.face_2]) < 0.0;
}

/// A convex corner in the plane below 60 degrees: what comes straight at it is faced by none of its flanks enough.
[[nodiscard]] inline bool is_sharp_corner(const SurfaceView<2>& surface, const Ridge& ridge) {
    return surface.normal[ridge.face_1].dot(surface.normal[ridge.face_2]) < -0.5 - cosine_rounding &&
           is_convex(surface, ridge);
}

}  // namespace abut::contact
