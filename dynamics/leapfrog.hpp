#pragma once
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"

namespace abut::dynamics {

/// The leapfrog (Störmer-Verlet) scheme: the usual symplectic choice. docs/integrators.md, Leapfrog.
///
///     q^{n+1}   = q^n + dt M^-1 p^{n+1/2}
///     p^{n+3/2} = p^{n+1/2} + dt F(q^{n+1})
///
/// conserves no energy unless F is linear; then it is 1/2 p^{n-1/2} . M^-1 p^{n+1/2} + V, which is what `pseudo_energy`
/// gives. It has no parasitic mode. Stable for omega dt < 2.
template <System S>
class Leapfrog : public Integrator<Leapfrog<S>, S> {
public:
    static constexpr bool has_half_steps = true;
    static constexpr bool takes_after_step = true;
    static constexpr bool takes_constraints = true;
    static constexpr bool takes_node_restart = false;

    /// Starts from q and p at the same time, p^{-+1/2} = p -+ dt/2 F(q). The system must outlive the integrator.
    /// Throws BadInput if dt is not > 0 and finite, the sizes disagree or a value is not finite.
    Leapfrog(S& system, std::vector<double> q, std::span<const double> p, double dt)
        : Integrator<Leapfrog, S>(system, std::move(q), dt) {
        this->begin(p);
    }

private:
    friend Integrator<Leapfrog, S>;

    void start(std::span<const double> p) { this->split_momentum(p); }
    void advance() {
        add_scaled_velocity(this->q_, this->dt_, this->system_.inverse_mass(), this->p_after_, this->q_next_);
        force_after_step(this->system_, this->q_, this->q_next_, this->time_, this->dt_, this->force_);
        std::swap(this->q_, this->q_next_);
        std::swap(this->p_before_, this->p_after_);
        add_scaled(this->p_before_, this->dt_, this->force_, this->p_after_);
        if constexpr (ConstrainedSystem<S>) this->system_.constrain_at(this->q_, this->dt_, this->p_after_);
    }
    [[nodiscard]] double conserved_energy(double potential) const { return this->staggered_kinetic_energy() + potential; }
};

}  // namespace abut::dynamics
