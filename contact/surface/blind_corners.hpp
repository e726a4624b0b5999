#pragma once
#include <cstdint>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// A corner of a body.
template <int Dim>
struct BlindCorner {
    std::int32_t body;     ///< as SurfaceView::body numbers it
    Vector<Dim> position;  ///< at rest [m]
};

/// Corners that contact cannot see: sticking out so sharply that a flat face may come straight at one of them while it
/// faces, by `facing_cosine`, none of the faces around it. A body enters others there without a contact. With n_i the
/// outward normals around a corner v, such a face has a normal -d for which
///
///     (w - v) . d <= 0 for all corners w of these faces,      n_i . d <= -facing_cosine for all i.
///
/// In 2D these are tips of at most 180 degrees - 2 acos(-facing_cosine): 23 degrees by default. In 3D d is tried
/// halfway between each two normals, and at equal angles to each three.
///
/// Returns one per position with such a corner, in the order of SurfaceView::vertices; corners at exactly one position are
/// one, that of the lowest body. Corners of a single face do not count. A lower |facing_cosine|
/// (-1 < facing_cosine < 0) sees sharper corners. Throws BadInput for array sizes that disagree; otherwise the surface
/// must be one that `check` lets pass.
template <int Dim>
[[nodiscard]] std::vector<BlindCorner<Dim>> blind_corners(const SurfaceView<Dim>& surface, double facing_cosine);

}  // namespace abut::contact
