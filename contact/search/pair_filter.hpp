#pragma once
// Private to the layer.
#include <algorithm>
#include <cstdint>
#include <span>

#include "abut/contact/pairs/pair.hpp"
#include "abut/contact/search/face_boxes.hpp"

namespace abut::contact {

/// Verdict of a search on two faces whose boxes overlap.
enum class PairVerdict { may_touch, not_facing, too_far_apart };

/// Whether g can come below `distance` where the faces share area: on the path from u_0 to u_1, or within a skin of u_0.
/// Faces that do not look at each other at all have no gap: their boxes decide.
template <int Dim>
[[nodiscard]] bool can_touch(const SurfaceView<Dim>& surface, const CandidateOptions& options, const RestFace<Dim>& rest_1,
                             const RestFace<Dim>& rest_2, std::span<const Vector<Dim>> u_0, std::span<const Vector<Dim>> u_1,
                             double skin) {
    const std::int32_t face_1 = rest_1.face, face_2 = rest_2.face;
    if (options.facing_cosine > 0.0 && !are_facing(surface, face_1, face_2, 0.0)) return true;
    // m = |m| n_12: with squares nothing has to be normalised
    const Vector<Dim> m = pair_direction(surface, face_1, face_2);
    const double mm = m.squaredNorm();
    const Vector<Dim> at_0 = apart(surface, face_1, face_2, u_0[face_1], u_0[face_2]);
    const Vector<Dim> at_1 = apart(surface, face_1, face_2, u_1[face_1], u_1[face_2]);
    const double gap_0 = at_0.dot(m), gap_1 = at_1.dot(m);  // times |m|
    const auto exceeds = [mm](double gap, double limit) { return gap > 0.0 && gap * gap > limit * limit * mm; };
    if (exceeds(gap_0, options.distance + skin) && exceeds(gap_1, options.distance)) return false;
    const double radius = (1.0 + 1e-12) * (rest_1.radius + rest_2.radius + std::max(skin, (at_1 - at_0).norm()));
    return at_0.squaredNorm() - gap_0 * gap_0 / mm <= radius * radius;
}

}  // namespace abut::contact
