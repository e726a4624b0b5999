#pragma once
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/path_mean.hpp"

namespace abut::dynamics {

/// The explicit pseudo-energy conserving scheme MEMM. docs/method.md, Time.
///
///     q^{n+1}   = q^n + dt M^-1 p^{n+1/2}
///     p^{n+3/2} = p^{n-1/2} + 2 dt mean of F over the straight path from q^n to q^{n+1}
///
/// conserves H~^n = 1/2 p^{n-1/2} . M^-1 p^{n+1/2} + V(q^n), less the work from outside, whatever dt. It is stable below the
/// stable step only, and H~ alone does not tell: print `energy_excess` and `parasitic_momentum` beside it.
template <System S>
class Memm : public Integrator<Memm<S>, S> {
public:
    static constexpr bool has_half_steps = true;
    static constexpr bool takes_after_step = true;
    static constexpr bool takes_constraints = true;
    static constexpr bool takes_node_restart = true;

    /// Starts from q and p at the same time, p^{-+1/2} = p -+ dt/2 F(q). The system must outlive the integrator.
    /// Throws BadInput if dt is not > 0 and finite, the sizes disagree, a value is not finite, or the system
    /// does not allow this mean.
    Memm(S& system, std::vector<double> q, std::span<const double> p, double dt, PathMean mean = PathMean::system)
        : Integrator<Memm, S>(system, std::move(q), dt), mean_force_(system, mean) {
        this->begin(p);
    }

    /// q^{n+1}, where the next step of the present dt ends [m]: its force does not change that. Valid until then.
    [[nodiscard]] std::span<const double> next_q() {
        add_scaled_velocity(this->q_, this->dt_, this->system_.inverse_mass(), this->p_after_, this->q_next_);
        return this->q_next_;
    }

private:
    friend Integrator<Memm, S>;

    void start(std::span<const double> p) { this->split_momentum(p); }
    void advance() {
        mean_force_(this->q_, next_q(), this->time_, this->dt_, this->force_);
        add_scaled(this->p_before_, 2.0 * this->dt_, this->force_, this->p_before_);
        if constexpr (ConstrainedSystem<S>) this->system_.constrain_along(this->q_next_, this->dt_, this->p_before_);
        std::swap(this->p_before_, this->p_after_);
        std::swap(this->q_, this->q_next_);
    }
    [[nodiscard]] double conserved_energy(double potential) const { return this->staggered_kinetic_energy() + potential; }

    PathMeanForce<S> mean_force_;
};

}  // namespace abut::dynamics
