#pragma once
// Private to the layer.
#include <algorithm>
#include <cstdint>

#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {

/// Whether two faces look at each other: n_1 . n_2 < facing_cosine.
template <int Dim>
[[nodiscard]] bool are_facing(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2,
                              double facing_cosine) {
    return surface.normal[face_1].dot(surface.normal[face_2]) < facing_cosine;
}

/// From the centroid of face 1 to that of face 2, displaced by u_1 and u_2 [m].
template <int Dim>
[[nodiscard]] Vector<Dim> apart(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2,
                                const Vector<Dim>& u_1, const Vector<Dim>& u_2) {
    return (surface.centroid[face_2] - surface.centroid[face_1]) + (u_2 - u_1);
}

/// One face is much larger than another whose |f| is that many times smaller: 1.45 in length. That is between meshes of one
/// kind, and near to no ratio that people choose, so that rounding has no say.
template <int Dim>
inline constexpr double much_larger_area = Dim == 2 ? 1.45 : 1.45 * 1.45;

template <int Dim>
[[nodiscard]] bool is_much_larger(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2) {
    return surface.area[face_1] > much_larger_area<Dim> * surface.area[face_2];
}

/// Which face gives n_12. `both`: it is the mean, along n_1 - n_2. A rigid face gives its own normal. Of two elastic
/// ones the larger does: with any other normal the distance of the centroids along it, times the sine of its tilt,
/// would count as gap, and bodies that are apart would be in contact; so the gap is the height of the smaller face's
/// centroid over it. Of faces of one size that which is farther from a sharp edge of its body gives its own: a corner
/// on a flat side would be pushed along it.
enum class NormalOf { both, face_1, face_2 };

template <int Dim>
[[nodiscard]] NormalOf normal_of(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2) {
    if (surface.is_rigid(face_2)) return NormalOf::face_2;
    if (surface.is_rigid(face_1)) return NormalOf::face_1;
    if (is_much_larger(surface, face_1, face_2)) return NormalOf::face_1;
    if (is_much_larger(surface, face_2, face_1)) return NormalOf::face_2;
    const std::uint8_t steps_1 = surface.steps_to_edge(face_1), steps_2 = surface.steps_to_edge(face_2);
    if (steps_1 == steps_2) return NormalOf::both;
    return steps_1 < steps_2 ? NormalOf::face_2 : NormalOf::face_1;
}

/// n_12 of any length.
template <int Dim>
[[nodiscard]] Vector<Dim> pair_direction(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2) {
    const Vector<Dim>&n_1 = surface.normal[face_1], &n_2 = surface.normal[face_2];
    switch (normal_of(surface, face_1, face_2)) {
        case NormalOf::face_1:
            return n_1;
        case NormalOf::face_2:
            return -n_2;
        case NormalOf::both:
            break;
    }
    return n_1 - n_2;
}

/// n_12, unit, from face 1's body into face 2's.
template <int Dim>
[[nodiscard]] Vector<Dim> pair_normal(const SurfaceView<Dim>& surface, std::int32_t face_1, std::int32_t face_2) {
    const Vector<Dim> direction = pair_direction(surface, face_1, face_2);
    if (normal_of(surface, face_1, face_2) != NormalOf::both) return direction;
    return direction.normalized();
}

/// Projects the corners of a face, displaced by `motion`, seen from `origin`; writes them counter-clockwise in the plane of
/// the pair (3D) or increasing (2D) from `to` on, and gives their end.
template <int Dim, class Output>
Output project_face(const SurfaceView<Dim>& surface, std::int32_t face, const Vector<Dim>& origin, const Vector<Dim>& motion,
                    const geometry::PlaneFrame<Dim>& frame, Output to) {
    Output end = to;
    for (const std::int32_t v : surface.vertices_of(face)) *end++ = frame.project((surface.vertices[v] - origin) + motion);
    if constexpr (Dim == 2) {
        if (to[1][0] < to[0][0]) std::swap(to[0], to[1]);
    } else {
        if (surface.normal[face].dot(frame.normal()) < 0.0) std::reverse(to, end);
    }
    return end;
}

/// Largest distance of a corner from the centroid [m].
template <int Dim>
[[nodiscard]] double circumradius(const SurfaceView<Dim>& surface, std::int32_t face) {
    double radius = 0.0;
    for (const std::int32_t v : surface.vertices_of(face))
        radius = std::max(radius, (surface.vertices[v] - surface.centroid[face]).norm());
    return radius;
}

}  // namespace abut::contact
