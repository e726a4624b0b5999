#pragma once
#include "abut/dynamics/point_system.hpp"

namespace abut::dynamics {

/// Moments of inertia about a point: a number in the plane, a tensor in space.
template <int Dim>
using Inertia = SmallMatrix<n_rotations<Dim>, n_rotations<Dim>>;

/// The angular velocity with which this inertia carries an angular momentum [rad/s]; none about axes without inertia, as of
/// points on a line.
template <int Dim>
[[nodiscard]] AngularMomentum<Dim> angular_velocity(const Inertia<Dim>& inertia, const AngularMomentum<Dim>& carried);

}  // namespace abut::dynamics
