#pragma once
#include <span>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/contact/overlap/overlaps.hpp"

namespace abut::contact {

/// How far the two faces of each overlap are apart in space [m], 0 where they touch or cross: what `Overlap::gap`, a height
/// read at one place along the normal of the pair, is not. `x` (n_vertices) [m] is where the vertices of the surface are.
/// It is never too large, and right to 1e-6 of the size of the faces. For reports: it costs about as much as a hundred
/// overlaps. Faces are taken as the convex hulls of their corners. Throws BadInput for a face that does not exist, another
/// number of positions than vertices, and a corner that is not finite.
template <int Dim>
[[nodiscard]] std::vector<double> face_distances(const SurfaceView<Dim>& surface, PointsView<Dim> x,
                                                 std::span<const Overlap<Dim>> overlaps);

}  // namespace abut::contact
