#pragma once
#include <cstdint>
#include <optional>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// The sharpest convex edge of a body, where two of its faces meet at the angle b inside the body.
template <int Dim>
struct SharpestEdge {
    std::int32_t body;
    double half_angle_sine;  ///< sin(b/2) [-]: 1 where the faces lie in one plane, 0.707 at the edge of a box
    Vector<Dim> midpoint;    ///< at rest [m]
};

/// The sharpest edges of two bodies.
template <int Dim>
struct EdgePair {
    SharpestEdge<Dim> edge_1;
    SharpestEdge<Dim> edge_2;

    /// sin(b_1/2) sin(b_2/2) [-]: where the edges cross at right angles, -n_1 . n_2 of each face of one with each of the
    /// other. At other angles some pair of faces looks at each other more.
    [[nodiscard]] double facing() const { return edge_1.half_angle_sine * edge_2.half_angle_sine; }
};

/// Edges that contact cannot see when they cross: the two bodies whose sharpest edges look at each other least, if that is
/// not below `facing_cosine` (-1 < facing_cosine < 0); nothing otherwise, and in 2D. The bodies pass through each other
/// there without a contact. One of the two is deformable, and they are not the same.
///
/// Edges are those that exactly two faces of a body share, with ends at exactly the same positions. Throws BadInput for
/// array sizes that disagree; otherwise the surface must be one that `check` lets pass. n log n.
template <int Dim>
[[nodiscard]] std::optional<EdgePair<Dim>> unseen_edges(const SurfaceView<Dim>& surface, double facing_cosine);

}  // namespace abut::contact
