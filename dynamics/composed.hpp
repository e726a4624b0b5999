#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/composition.hpp"
#include "abut/dynamics/integrator.hpp"
#include "abut/dynamics/path_mean.hpp"

namespace abut::dynamics {

/// Counts of `Composed::project` and `Composed::synchronise`.
struct SynchronisationReport {
    std::int64_t done = 0;
    std::int64_t shortened = 0;  ///< only a part of the alternating mode could be taken, since too little moves
    std::int64_t skipped = 0;    ///< nothing could be taken: at rest, at turning points
};

/// MEMM as a splitting of a doubled system, composed to order 2, 4 or 6. docs/integrators.md, Higher orders. Two copies of
/// the momentum, a and b, are `p_before` and `p_after`; both are at t^n.
///
///     A(s): q += s M^-1 b, a += 2 s mean of F over that straight path        B(s): the same with a and b exchanged
///
/// Each A and B conserves H~ = 1/2 a . M^-1 b + V(q), also where s < 0, and any sequence of steps does, whatever their
/// length: `step(dt, StepChange::keep)`; where lengths change often, read PairsReport. H - H~ = |a - b|^2/8 in M^-1,
/// `energy_excess`, is of order dt^2p; where it has to stay small for long, call `project` or `synchronise` after steps.
/// Stable for omega dt < 4 (strang), 5.44 (suzuki_4) and 6.26 (both of Blanes and Moan): a higher order pays for smooth
/// motions, not for waves on a mesh.
template <System S>
class Composed : public Integrator<Composed<S>, S> {
public:
    static constexpr bool has_half_steps = false;
    static constexpr bool takes_after_step = false;
    static constexpr bool takes_constraints = false;
    static constexpr bool takes_node_restart = false;
    static constexpr const char* for_one_rank = "a composition of steps";

    /// Starts from a = b = p at q. The system must outlive the integrator. Throws BadInput if dt is not > 0 and finite, the
    /// sizes disagree, a value is not finite, the mean would spoil the order, or the system has what sub-steps that go back
    /// in time cannot have: losses, constraints, work from outside, a memory of where it has been.
    Composed(S& system, std::vector<double> q, std::span<const double> p, double dt, Composition composition,
             PathMean mean = PathMean::system)
        : Integrator<Composed, S>(system, std::move(q), dt),
          composition_(composition),
          flows_(sub_flows(composition)),
          mean_force_(checked(system, composition, mean), mean) {
        this->begin(p);
        difference_.resize(this->q_.size());
    }

    [[nodiscard]] Composition composition() const { return composition_; }

    /// Projection on a = b, with the true energy H = H~: (a + b)/2 = r + k, and both become r + sigma k, where sigma^2 = 1 -
    /// |a - b|^2/(8 E_k), E_k = |k|^2/2. The order stays. `rigid` is r [kg m/s], a part of the momenta that stays as it is,
    /// orthogonal to k in M^-1, as the rigid motion of free bodies is; none if empty. Skips, and counts, a node with
    /// sigma^2 < 3/4 or E_k = 0; the next one can be projected. Not after each step of a wave: a = b is not free of the
    /// alternating mode, (omega dt)^4/2048 of a mode's energy goes there each time. Throws BadInput for a size of `rigid`
    /// other than that of q.
    bool project(std::span<const double> rigid = {}) {
        detail::check_rigid(rigid.size(), this->q_.size());
        split(rigid);
        const double vibration = 0.5 * this->mass_product(mean_, mean_), scale = 1.0 - this->energy_excess() / vibration;
        if (!(vibration > 0.0) || !(scale >= least_projected)) {
            ++projections_.skipped;
            return false;
        }
        std::fill(difference_.begin(), difference_.end(), 0.0);
        join(rigid, std::sqrt(scale));
        ++projections_.done;
        return true;
    }
    [[nodiscard]] const SynchronisationReport& projections() const { return projections_; }

    /// Takes the alternating mode out, of `strang` alone, for a next step of dt: the difference w = a - b becomes
    /// w* = dt/8 (F(q + dt/4 M^-1 b) - F(q - dt/4 M^-1 b)), and sigma^2 = 1 + (|w*|^2 - |w|^2)/(8 E_k) keeps H~; halves the
    /// change until 1/4 <= sigma^2 <= 1.21. b is the copy that the outer sub-steps do not kick. `rigid` as in `project`.
    /// 2 forces. Throws Misuse for another composition.
    bool synchronise(std::span<const double> rigid = {}) {
        detail::check_synchronised(composition_);
        detail::check_rigid(rigid.size(), this->q_.size());
        find_free_difference();
        split(rigid);
        const double vibration = 0.5 * this->mass_product(mean_, mean_), before = 8.0 * this->energy_excess();
        add_scaled(this->p_before_, -1.0, this->p_after_, this->force_);  // w
        for (int halvings = 0; halvings < most_halvings; ++halvings) {
            const double scale = 1.0 + (this->mass_product(difference_, difference_) - before) / (8.0 * vibration);
            if (scale >= least_scale && scale <= largest_scale) {
                join(rigid, std::sqrt(scale));
                ++synchronisations_.done;
                if (halvings > 0) ++synchronisations_.shortened;
                return true;
            }
            for (std::size_t i = 0; i < difference_.size(); ++i) difference_[i] = 0.5 * (difference_[i] + this->force_[i]);
        }
        ++synchronisations_.skipped;
        return false;
    }
    [[nodiscard]] const SynchronisationReport& synchronisations() const { return synchronisations_; }

private:
    friend Integrator<Composed, S>;
    static constexpr double least_projected = 0.75, least_scale = 0.25, largest_scale = 1.21;  // of sigma^2
    static constexpr int most_halvings = 20;

    static S& checked(S& system, Composition composition, PathMean mean) {
        if constexpr (FollowedSystem<S>)
            detail::refuse_composed(
                "the system must be led along every step once, as contact is, and sub-steps go back in time.");
        if constexpr (RateSystem<S> || requires { system.dissipated(); })
            detail::refuse_composed("the system has losses, which sub-steps that go back in time would return.");
        if constexpr (requires { system.work(); })
            detail::refuse_composed("the system receives work from outside, which would not be counted.");
        detail::check_composition_mean(composition, mean, dynamics::mean_is_exact(system));
        return system;
    }

    void start(std::span<const double> p) {
        this->p_before_.assign(p.begin(), p.end());
        this->p_after_ = this->p_before_;
    }
    void advance() {
        double time = this->time_;
        for (const SubFlow& flow : flows_) {
            const double s = flow.length * this->dt_;
            auto& kicked = flow.kicks_a ? this->p_before_ : this->p_after_;
            const auto& carrying = flow.kicks_a ? this->p_after_ : this->p_before_;
            add_scaled_velocity(this->q_, s, this->system_.inverse_mass(), carrying, this->q_next_);
            mean_force_(this->q_, this->q_next_, time, s, this->force_);
            add_scaled(kicked, 2.0 * s, this->force_, kicked);
            std::swap(this->q_, this->q_next_);
            time += s;
        }
    }
    /// A step is symmetric: turned round, a stays a.
    void turn() { std::swap(this->p_before_, this->p_after_); }
    [[nodiscard]] double conserved_energy(double potential) const { return this->staggered_kinetic_energy() + potential; }

    /// w* [kg m/s], into difference_.
    void find_free_difference() {
        const double quarter = 0.25 * this->dt_;
        const auto force_at = [&](double s, std::vector<double>& force) {
            add_scaled_velocity(this->q_, s, this->system_.inverse_mass(), this->p_after_, this->q_next_);
            this->system_.force(this->q_next_, force);
        };
        force_at(-quarter, this->force_);
        force_at(quarter, difference_);
        for (std::size_t i = 0; i < difference_.size(); ++i)
            difference_[i] = 0.5 * quarter * (difference_[i] - this->force_[i]);
    }
    /// k = (a + b)/2 - r, into mean_.
    void split(std::span<const double> rigid) {
        mean_.resize(this->q_.size());
        for (std::size_t i = 0; i < mean_.size(); ++i)
            mean_[i] = 0.5 * (this->p_before_[i] + this->p_after_[i]) - (rigid.empty() ? 0.0 : rigid[i]);
    }
    /// a and b of r + sigma k, with the difference between them.
    void join(std::span<const double> rigid, double sigma) {
        for (std::size_t i = 0; i < mean_.size(); ++i) {
            const double p = sigma * mean_[i] + (rigid.empty() ? 0.0 : rigid[i]);
            this->p_before_[i] = p + 0.5 * difference_[i];
            this->p_after_[i] = p - 0.5 * difference_[i];
        }
    }

    Composition composition_;
    std::vector<SubFlow> flows_;
    PathMeanForce<S> mean_force_;
    std::vector<double> mean_, difference_;  // work arrays
    SynchronisationReport projections_, synchronisations_;
};

}  // namespace abut::dynamics
