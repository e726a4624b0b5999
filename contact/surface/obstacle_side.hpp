#pragma once
#include <span>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/contact/surface/obstacle.hpp"

namespace abut::contact {

/// The placement of an obstacle at a time: its `placement`, or else its `path`, or at rest.
template <int Dim>
[[nodiscard]] Placement<Dim> placement_at(const RigidObstacle<Dim>& obstacle, double time);

/// How far a point is from an obstacle whose faces have these corners (RigidObstacle::faces) [m]: > 0 in front of it, where
/// contact acts, < 0 behind it. Of several faces that are nearest, at an edge, that decides which looks most towards or away
/// from the point. Infinity where there is no face.
template <int Dim>
[[nodiscard]] double side_of(std::span<const std::vector<Vector<Dim>>> faces, const Vector<Dim>& point);

}  // namespace abut::contact
