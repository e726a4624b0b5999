#pragma once
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"

namespace abut::dynamics {

namespace detail {
[[noreturn]] void refuse_gauge(double potential, double gauge);
[[noreturn]] void refuse_varying_potential();
}  // namespace detail

/// The explicit energy-quadratising scheme of Bilbao, Ducceschi and Zama (JCP:X, 2023). docs/integrators.md, Bilbao.
/// With psi = sqrt(2 (V + c)) and g = -F/psi, at each node
///
///     p^{n+1/2}   = p^{n-1/2} - dt/2 g (psi^{n+1/2} + psi^{n-1/2})
///     psi^{n+1/2} = psi^{n-1/2} + dt/2 g . M^-1 (p^{n+1/2} + p^{n-1/2})
///
/// in closed form. It conserves 1/2 p . M^-1 p + psi^2/2 - c at half steps, whatever dt; that number does not know whether
/// psi is still sqrt(2 (V + c)): print `gauge_defect` beside it. One psi couples the whole scene.
template <System S>
class Bilbao : public Integrator<Bilbao<S>, S> {
public:
    static constexpr bool has_half_steps = true;
    static constexpr bool takes_after_step = false;
    static constexpr bool takes_constraints = false;
    static constexpr bool takes_node_restart = false;

    /// Starts from q and p at the same time. The gauge c [J] keeps V + c positive: a scene with free flight needs c > 0. The
    /// system must outlive the integrator. Throws BadInput if dt is not > 0 and finite, the sizes disagree, a
    /// value is not finite or V depends on time; Diverged, also from `step`, where V + c is not > 0.
    Bilbao(S& system, std::vector<double> q, std::span<const double> p, double dt, double gauge)
        : Integrator<Bilbao, S>(system, std::move(q), dt), gauge_(gauge) {
        if constexpr (FollowedSystem<S>)
            if (!system.is_autonomous()) detail::refuse_varying_potential();
        this->begin(p);
    }

    /// psi - sqrt(2 (V + c)) half a step before the present node [J^(1/2)]: the hidden error of the scheme. Evaluates V
    /// there, as a restart does: a solid with contact needs a skin that reaches so far.
    [[nodiscard]] double gauge_defect() { return psi_before_ - psi_of(half_step_before()); }

private:
    friend Integrator<Bilbao, S>;

    void start(std::span<const double> p) {
        this->system_.force(this->q_, this->force_);
        add_scaled(p, -0.5 * this->dt_, this->force_, this->p_before_);
        psi_before_ = psi_of(half_step_before());
        kick();
    }
    void advance() {
        add_scaled_velocity(this->q_, this->dt_, this->system_.inverse_mass(), this->p_after_, this->q_next_);
        force_after_step(this->system_, this->q_, this->q_next_, this->time_, this->dt_, this->force_);
        std::swap(this->q_, this->q_next_);
        std::swap(this->p_before_, this->p_after_);
        psi_before_ = psi_after_;
        kick();
    }
    /// p^{n+1/2} and psi^{n+1/2} from p^{n-1/2} and psi^{n-1/2}, with the force at q^n in force_.
    void kick() {
        const double psi = psi_of(this->q_);
        for (double& f : this->force_) f /= -psi;  // g
        const double dt = this->dt_;
        const double gamma = 0.25 * dt * dt * this->mass_product(this->force_, this->force_);
        psi_after_ = ((1.0 - gamma) * psi_before_ + dt * this->mass_product(this->force_, this->p_before_)) / (1.0 + gamma);
        add_scaled(this->p_before_, -0.5 * dt * (psi_after_ + psi_before_), this->force_, this->p_after_);
    }
    /// q^n - dt/2 M^-1 p^{n-1/2}
    [[nodiscard]] std::span<const double> half_step_before() {
        add_scaled_velocity(this->q_, -0.5 * this->dt_, this->system_.inverse_mass(), this->p_before_, this->q_next_);
        return this->q_next_;
    }
    [[nodiscard]] double psi_of(std::span<const double> q) {
        const double potential = this->system_.potential(q);
        if (!(potential + gauge_ > 0.0)) detail::refuse_gauge(potential, gauge_);
        return std::sqrt(2.0 * (potential + gauge_));
    }
    [[nodiscard]] double conserved_energy(double) const {
        return 0.5 * (this->mass_product(this->p_after_, this->p_after_) + psi_after_ * psi_after_) - gauge_;
    }
    void turn() { std::swap(psi_before_, psi_after_); }
    [[nodiscard]] std::vector<double> of_scheme() const { return {psi_before_, psi_after_}; }
    void set_of_scheme(std::span<const double> psi) {
        psi_before_ = psi[0];
        psi_after_ = psi[1];
    }

    double gauge_;
    double psi_before_ = 0.0;  // psi^{n-1/2} [J^(1/2)]
    double psi_after_ = 0.0;
};

}  // namespace abut::dynamics
