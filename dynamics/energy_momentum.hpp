#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/newton.hpp"
#include "abut/dynamics/path_mean.hpp"

namespace abut::dynamics {

/// The implicit energy-momentum scheme with the mean force as its discrete gradient. docs/integrators.md, Energy-momentum.
///
///     q^{n+1} = q^n + dt M^-1 (p^n + p^{n+1})/2
///     p^{n+1} = p^n + dt mean of F over the straight path from q^n to q^{n+1}
///
/// conserves the energy H itself, exactly if the mean is exact, and is stable for any dt; Newton's method with a sparse LU
/// decomposition in every iteration makes it a scheme for small systems. It has no half-step momenta: `p_before` and
/// `p_after` are both p^n.
template <StiffnessSystem S>
requires(!FollowedSystem<S>) class EnergyMomentum : public Integrator<EnergyMomentum<S>, S> {
public:
    static constexpr bool has_half_steps = false;
    static constexpr bool takes_after_step = false;
    static constexpr bool takes_constraints = false;
    static constexpr bool takes_node_restart = false;
    static constexpr const char* for_one_rank = "an implicit scheme";

    /// Starts from q and p at the same time. The system must outlive the integrator. Throws BadInput if dt is
    /// not > 0 and finite, the sizes disagree, a value is not finite, or the system does not allow this mean. `step` throws
    /// Diverged if Newton's method does not converge; q and p are then those before it.
    EnergyMomentum(S& system, std::vector<double> q, std::span<const double> p, double dt, PathMean mean = PathMean::system)
        : Integrator<EnergyMomentum, S>(system, std::move(q), dt),
          mean_force_(system, mean),
          matrix_(system.size(), mass_entries(system.inverse_mass())) {
        for (auto* array : {&residual_, &change_, &q_on_path_}) array->resize(system.size());
        this->begin(p);
    }

private:
    friend Integrator<EnergyMomentum, S>;
    static constexpr int most_iterations = 50;
    static constexpr double first_convergence = 1e-10;  // of the largest |q|: from here on until rounding stops it

    void start(std::span<const double> p) {
        this->p_before_.assign(p.begin(), p.end());
        this->p_after_ = this->p_before_;
    }

    void advance() {
        add_scaled_velocity(this->q_, this->dt_, this->system_.inverse_mass(), this->p_after_, this->q_next_);
        iterate();
        mean_force_(this->q_, this->q_next_, this->time_, this->dt_, this->force_);
        std::swap(this->q_, this->q_next_);
        add_scaled(this->p_after_, this->dt_, this->force_, this->p_after_);
        this->p_before_ = this->p_after_;
    }

    /// Newton's method for q^{n+1}, until it has converged and rounding stops it.
    void iterate() {
        double last = std::numeric_limits<double>::infinity();
        for (int i = 1;; ++i) {
            const double change = correct(last > first_convergence);
            if (change == 0.0 || (change < first_convergence && change > 0.1 * last)) return;
            if (i == most_iterations || !std::isfinite(change)) detail::refuse_newton(i, change, this->dt_);
            last = change;
        }
    }

    /// One iteration for M (q^{n+1} - q^n) - dt p^n - dt^2/2 mean F = 0. The largest change of q over the largest |q|.
    double correct(bool with_new_matrix) {
        const double dt = this->dt_;
        std::vector<double>& q_1 = this->q_next_;
        mean_force_(this->q_, q_1, this->time_, dt, this->force_);
        add_scaled(q_1, -1.0, this->q_, change_);
        matrix_.multiply_mass(change_, residual_);
        for (std::size_t k = 0; k < residual_.size(); ++k)
            residual_[k] -= dt * (this->p_after_[k] + 0.5 * dt * this->force_[k]);
        if (with_new_matrix) factorise(this->q_, q_1);
        matrix_.solve(residual_, change_);
        add_scaled(q_1, -1.0, change_, q_1);
        const double size = std::max(largest(this->q_), largest(q_1));
        return largest(change_) / (size > 0.0 ? size : 1.0);
    }

    /// dt^2/2 times the derivative of the mean force at the end of the path: - integral of tau K(q_0 + tau (q_1 - q_0)).
    void factorise(std::span<const double> q_0, std::span<const double> q_1) {
        const Quadrature rule = gauss_legendre(3);
        stiffness_.clear();
        for (int k = 0; k < rule.size; ++k) {
            for (std::size_t i = 0; i < q_on_path_.size(); ++i) q_on_path_[i] = q_0[i] + rule.node[k] * (q_1[i] - q_0[i]);
            this->system_.append_stiffness(q_on_path_, 0.5 * this->dt_ * this->dt_ * rule.weight[k] * rule.node[k],
                                           stiffness_);
        }
        matrix_.factorise(stiffness_);
    }

    static double largest(std::span<const double> values) {
        double size = 0.0;  // NaN stays
        for (const double value : values)
            if (!std::isnan(size) && !(std::abs(value) <= size)) size = std::abs(value);
        return size;
    }
    [[nodiscard]] double conserved_energy(double potential) const { return this->staggered_kinetic_energy() + potential; }

    PathMeanForce<S> mean_force_;
    NewtonMatrix matrix_;
    std::vector<MatrixEntry> stiffness_;
    std::vector<double> residual_;
    std::vector<double> change_;
    std::vector<double> q_on_path_;
};

}  // namespace abut::dynamics
