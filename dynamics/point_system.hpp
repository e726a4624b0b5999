#pragma once
#include <concepts>
#include <span>

#include "abut/base/vector.hpp"
#include "abut/dynamics/system.hpp"

namespace abut::dynamics {

/// A system of points with a mass that move in space, `dimension` 1, 2 or 3: q holds their displacements (n, dimension). Its
/// ledger also takes `work()` [J], `contact_counts()` and `rotations(q)`, how far each body has turned [rad], where it has
/// them.
template <class S>
concept PointSystem = System<S> && requires(const S& system) {
    { S::dimension } -> std::convertible_to<int>;
    { system.rest_positions() } -> std::convertible_to<std::span<const Vector<S::dimension>>>;  ///< (n, dimension) [m]
    { system.masses() } -> std::convertible_to<std::span<const double>>;                        ///< (n) [kg]
};

template <int Dim>
using AngularMomentum = AxialVector<Dim>;
template <int Dim>
inline constexpr int n_rotations = AxialVector<Dim>::RowsAtCompileTime;

/// The positions about which the mean forces inside a body have no moment together: they decide which angular momentum a
/// filter and a restart leave as it is. MEMM conserves it where contact has no moment about these positions either: under
/// `rest` while nothing touches, under `mid_step` always (contact::NodalContact).
enum class MomentArms {
    rest,      ///< X, as under linear strain, where a rotation moves points along straight lines: sum X × p
    mid_step,  ///< the mean of x^n and x^{n+1}, as where bodies turn: J~, see `pseudo_angular_momentum`
};

/// A point system that says so. Its masses are lumped: 1/m of each point, per component, is all of `inverse_mass`.
template <class S>
concept MomentSystem = PointSystem<S> && requires(const S& system) {
    { system.moment_arms() } -> std::convertible_to<MomentArms>;
};

/// omega × arm, the velocity of a point of a body that turns.
template <int Dim>
[[nodiscard]] Vector<Dim> turning_velocity(const AngularMomentum<Dim>& omega, const Vector<Dim>& arm) {
    if constexpr (Dim == 1)
        return Vector<1>(0.0);
    else if constexpr (Dim == 2)
        return {-omega[0] * arm[1], omega[0] * arm[0]};
    else
        return moment<3>(omega, arm);
}

}  // namespace abut::dynamics
