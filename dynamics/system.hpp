#pragma once
#include <concepts>
#include <cstddef>
#include <span>
#include <type_traits>

#include "abut/geometry/vector.hpp"

namespace abut::dynamics {

/// What an integrator steps: positions q with a diagonal mass and a potential. All arrays hold one double a degree of
/// freedom. `mean_force` is the exact mean of the force along the straight way from q_0 (at time t) to q_1 (at t + dt);
/// it is called once a step, in order, since contact remembers which pairs it has admitted.
template <class S>
concept System = requires(S& system, std::span<const double> q, std::span<double> force, double t, double dt) {
    { system.size() } -> std::convertible_to<std::size_t>;
    { system.inverse_mass() } -> std::convertible_to<std::span<const double>>;  ///< [1/kg]
    system.force(q, force);                                                     ///< F(q) = -dV/dq [N]
    system.mean_force(q, q, t, dt, force);                                      ///< [N]
    { system.potential(q) } -> std::convertible_to<double>;                     ///< V(q) [J]
    { system.work() } -> std::convertible_to<double>;  ///< done on the system from outside since the start [J]
};

/// Arrays of shape (n, Dim) and arrays of n vectors are the same memory.
template <int Dim, class Double>
[[nodiscard]] auto as_vectors(std::span<Double> values) {
    using V = std::conditional_t<std::is_const_v<Double>, const Vector<Dim>, Vector<Dim>>;
    return std::span<V>(reinterpret_cast<V*>(values.data()), values.size() / Dim);
}

}  // namespace abut::dynamics
