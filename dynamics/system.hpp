#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/dynamics/mass.hpp"

namespace abut::dynamics {

/// System that an integrator steps: positions q with a mass and a potential. All arrays hold one double per degree of
/// freedom. `inverse_mass` is a plain array of 1/m, or the factors of a sparse matrix (InverseMass).
template <class S>
concept System = requires(S& system, std::span<const double> q, std::span<double> force) {
    { system.size() } -> std::convertible_to<std::size_t>;
    add_scaled_velocity(q, 1.0, system.inverse_mass(), q, force);  ///< [1/kg]
    system.force(q, force);                                        ///< F(q) = -dV/dq [N]
    { system.potential(q) } -> std::convertible_to<double>;        ///< V(q) [J]
};

/// A system that knows the mean of its force along the straight path from q_0 (at time t) to q_1 (at t + dt): exactly, or by
/// any other rule with mean . (q_1 - q_0) = V(q_0) - V(q_1) that tends to F (a discrete gradient).
template <class S>
concept PathMeanSystem = System<S> &&
    requires(S& system, std::span<const double> q, std::span<double> force, double t, double dt) {
    system.mean_force(q, q, t, dt, force);  ///< [N]
};

/// A system that remembers where it has been, as contact remembers which pairs are in contact: it must be led along every
/// step, in order, by exactly one of `mean_force` and `end_force`.
template <class S>
concept FollowedSystem = PathMeanSystem<S> &&
    requires(S& system, std::span<const double> q, std::span<double> force, double t, double dt) {
    system.end_force(q, q, t, dt, force);                     ///< F at the end of the step from q_0 to q_1 [N]
    { system.work() } -> std::convertible_to<double>;         ///< done on it from outside since the start [J]
    { system.is_autonomous() } -> std::convertible_to<bool>;  ///< whether V depends on q alone, not on time
};

/// A system some points of which stay at the distances that they have. What holds them are impulses along the lines between
/// them: as these lie in the middle of a step they do no work on it and have no moment about its mean positions. Only
/// schemes that call this may run it where `has_constraints`. On several ranks points are those of this one, and to
/// constrain them is a call of all.
template <class S>
concept ConstrainedSystem = System<S> &&
    requires(S& system, std::int32_t point, std::span<const double> q, std::span<double> p, double dt) {
    { system.has_constraints() } -> std::convertible_to<bool>;
    { system.is_constrained(point) } -> std::convertible_to<bool>;  ///< whether it belongs to a rigid body
    system.constrain_along(q, dt, p);  ///< p of the next half step from q, along the lines of the last `mean_force`
    system.constrain_at(q, dt, p);     ///< the same along the lines in q; dt < 0: of the half step before
};

/// A system with forces on rates, as of dashpots: it knows those of its steps, and is told them where a run starts.
template <class S>
concept RateSystem = System<S> && requires(S& system, std::span<const double> q, std::span<const double> p) {
    system.set_rates(q, p);  ///< those of the last step, from momenta p in q
};

/// F(q_1), where a step from q_0 at time t has ended.
template <System S>
void force_after_step(S& system, std::span<const double> q_0, std::span<const double> q_1, double t, double dt,
                      std::span<double> force) {
    if constexpr (FollowedSystem<S>)
        system.end_force(q_0, q_1, t, dt, force);
    else
        system.force(q_1, force);
}

/// A system with second derivatives, for Newton's method.
template <class S>
concept StiffnessSystem = System<S> && requires(S& system, std::span<const double> q, std::vector<MatrixEntry>& entries) {
    system.append_stiffness(q, 1.0, entries);  ///< adds the entries of 1.0 d^2V/dq^2 [N/m]
};

/// Degrees of freedom that fly freely, each since its own last node.
struct FreeFlight {
    std::span<const double> q;            ///< of each at its node [m]
    std::span<const double> v;            ///< since then [m/s]
    std::span<const std::int32_t> level;  ///< of each
    std::span<const double> elapsed;      ///< since the node of each level [s]

    /// Position of i at dt from now.
    [[nodiscard]] double at(std::size_t i, double dt) const { return q[i] + (elapsed[level[i]] + dt) * v[i]; }
};

/// A system whose forces fall into parts, each of a few degrees of freedom: what local time steps need. A level is a rank:
/// 0 has the longest steps. Each part goes with the finest level among those that it touches.
template <class S>
concept LocalSystem = System<S> && requires(S& system, std::span<const std::int32_t> level, const FreeFlight& flight,
                                            std::span<double> impulse, double t, double dt) {
    system.set_levels(1, level);                    ///< how many there are, and that of each degree of freedom
    system.add_impulse(0, flight, t, dt, impulse);  ///< + integral of the parts of a level over dt from now, t [N s]
};

}  // namespace abut::dynamics
