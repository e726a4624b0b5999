#pragma once
#include <functional>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::solid {

/// The boundary of a mesh as a rigid body that moves on a path (translation from rest at a time [m]; empty: it stands
/// still). Its faces must be flat and convex, as those of any contact surface; the cells inside do not matter.
template <int Dim>
[[nodiscard]] contact::RigidObstacle<Dim> rigid_obstacle(const mesh::Mesh<Dim>& mesh,
                                                         std::function<Vector<Dim>(double time)> path = {});

}  // namespace abut::solid
