#pragma once
#include <functional>
#include <vector>

#include "abut/contact/surface/placement.hpp"
#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// A rigid body that moves on a given path: it has no energy, so its partner takes the whole correction.
template <int Dim>
struct RigidObstacle {
    std::vector<std::vector<Vector<Dim>>> faces;   ///< corners of each face, outside as in Surface::append [m]
    std::function<Vector<Dim>(double time)> path;  ///< translation from rest at a time [m]; empty: it stands still
    /// Placement at a time, turns included, for the pair potential alone; then `path` is not used
    std::function<Placement<Dim>(double time)> placement = {};
};

/// A square (3D) or segment (2D) of a plane, half_width in every direction about `point`, facing along `normal`.
/// Throws BadInput for a zero normal or a half_width that is not finite and > 0.
template <int Dim>
[[nodiscard]] RigidObstacle<Dim> plane_obstacle(const Vector<Dim>& point, const Vector<Dim>& normal, double half_width,
                                                std::function<Vector<Dim>(double time)> path = {});

/// A plane through `point` that is without end to all that stays within `reach` of `middle`, seen along the normal: one face
/// without a seam, a triangle (3D) or segment (2D) about the foot of `middle`. Its coordinates are as large as its
/// reach, and gaps are rounded to 1e-16 of that: a few thousand sizes of the bodies cost nothing. Throws as
/// `plane_obstacle`.
template <int Dim>
[[nodiscard]] RigidObstacle<Dim> endless_plane_obstacle(const Vector<Dim>& point, const Vector<Dim>& normal,
                                                        const Vector<Dim>& middle, double reach,
                                                        std::function<Vector<Dim>(double time)> path = {});

/// Appends the faces of an obstacle to a surface, as the rigid body number `body`.
template <int Dim>
void append(Surface<Dim>& surface, const RigidObstacle<Dim>& obstacle, std::int32_t body);

}  // namespace abut::contact
