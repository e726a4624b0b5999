#pragma once
#include <cstdint>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// At a sharp edge (3D) or corner (2D) of a body, the normals of its two faces have a scalar product below this: they turn
/// by more than 53 degrees. Boxes, rims of cylinders and hexagonal bars have sharp edges; round surfaces have none, unless
/// their mesh is very coarse.
inline constexpr double sharp_edge_cosine = 0.6;

/// For each face the number of steps from face to face, over common edges (corners in 2D), to the nearest one that borders a
/// sharp convex edge of its body, at most `far_from_sharp_edge`: SurfaceView::steps_to_sharp_edge. Edges are those that
/// exactly two faces of the surface share, with ends at exactly the same positions: the rim of an open surface, as where a
/// plane of symmetry cuts a body, is none. Throws BadInput for array sizes that disagree; otherwise the surface must be one
/// that `check` lets pass. n log n.
template <int Dim>
[[nodiscard]] std::vector<std::uint8_t> steps_to_sharp_edge(const SurfaceView<Dim>& surface);

}  // namespace abut::contact
