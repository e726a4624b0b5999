#pragma once
#include <span>
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::dynamics {
template <int Dim>
class RunView;
}

namespace abut::solid {

template <int Dim>
class Solid;

/// Mass, mean velocity and rotation of a body.
template <int Dim>
struct BodyMotion {
    double mass;           ///< [kg]
    Vector<Dim> velocity;  ///< of the centre of mass, from p = (p^- + p^+)/2 [m/s]
    double rotation;       ///< from its position at rest [rad], 0 to pi
    AxialVector<Dim> spin =
        AxialVector<Dim>::Zero();  ///< angular velocity as of a rigid body with its angular momentum [rad/s]
};
/// Motion of each body, at the node of `run`; `solid` is that of the run. A call of all ranks: rank 0 has the result, the
/// others nothing.
template <int Dim>
[[nodiscard]] std::vector<BodyMotion<Dim>> body_motions(const dynamics::RunView<Dim>& run, const Solid<Dim>& solid);

/// Momenta p (n_cells, Dim) [kg m/s] of bodies that move as a whole, one velocity per body [m/s]. Throws BadInput for
/// another number of velocities than bodies.
template <int Dim>
[[nodiscard]] std::vector<double> uniform_momentum(const Solid<Dim>& solid, std::span<const Vector<Dim>> body_velocity);

}  // namespace abut::solid
