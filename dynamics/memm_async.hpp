#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"

namespace abut::dynamics {

/// The local steps of a run: level l takes `parts[l]` steps in one step of the scheme.
struct LocalSteps {
    std::vector<std::int32_t> parts;  ///< 1 first, each a multiple of the one before: 1, 2, 4, 8
    std::vector<std::int32_t> level;  ///< of each degree of freedom
};

namespace detail {
/// Throws BadInput.
void check_local_steps(const LocalSteps& steps, std::size_t size);
}  // namespace detail

/// MEMM with a time step for each degree of freedom. docs/integrators.md, Local steps.
///
/// Each one flies freely between its own nodes t^k and collects the impulse I of the forces on it, integrated exactly along
/// the motion of all that are involved, which is straight between neighbouring nodes of any of them. At its node
///
///     p^{k+3/2} = p^{k-1/2} + 2 I,   I = 0
///
/// `step` goes from one node that all have in common to the next, `dt` apart; only there are q, p and the energies to be
/// read. 1/2 p^{k-1/2} . M^-1 p^{k+1/2} + V is exact at these nodes, and linear momentum, too. Each step must be stable for
/// those who take it, and nothing may resonate with a step: for solids `local_steps` sees to both. A mass that couples
/// degrees of freedom is not allowed.
template <LocalSystem S>
requires std::convertible_to<decltype(std::declval<S&>().inverse_mass()), std::span<const double>>
class MemmAsync : public Integrator<MemmAsync<S>, S> {
public:
    static constexpr bool has_half_steps = true;
    static constexpr bool takes_after_step = false;
    static constexpr bool takes_constraints = false;
    static constexpr bool takes_node_restart = false;
    static constexpr const char* for_one_rank = "a scheme with local steps";

    /// Starts from q and p at the same time, p^{-+1/2} = p -+ dt_i/2 F(q). The system must outlive the integrator.
    /// Throws BadInput if dt is not > 0 and finite, the sizes disagree, a value is not finite or the local
    /// steps do not fit. After an error in `step` q and p are of different times: the run is over.
    MemmAsync(S& system, std::vector<double> q, std::span<const double> p, double dt, LocalSteps steps)
        : Integrator<MemmAsync, S>(system, std::move(q), dt), steps_(std::move(steps)) {
        detail::check_local_steps(steps_, system.size());
        dofs_.resize(steps_.parts.size());
        for (std::size_t i = 0; i < steps_.level.size(); ++i) dofs_[steps_.level[i]].push_back(i);
        velocity_.resize(system.size());
        impulse_.assign(system.size(), 0.0);
        elapsed_.assign(steps_.parts.size(), 0.0);
        system.set_levels(static_cast<std::int32_t>(steps_.parts.size()), steps_.level);
        this->begin(p);
    }

    /// Time step of the degree of freedom i [s].
    [[nodiscard]] double local_step(std::size_t i) const { return step_of_level(steps_.level[i]); }

private:
    friend Integrator<MemmAsync, S>;

    void start(std::span<const double> p) {
        this->split_momentum(p);
        for (const auto& dofs : dofs_) set_velocity(dofs);
    }

    void advance() {
        const std::int32_t finest = steps_.parts.back();
        const double part = this->dt_ / finest;
        const FreeFlight flight{this->q_, velocity_, steps_.level, elapsed_};
        for (std::int32_t k = 0; k < finest; ++k) {
            for (std::size_t level = 0; level < dofs_.size(); ++level)
                if (is_node(level, k))
                    this->system_.add_impulse(static_cast<std::int32_t>(level), flight, this->time_ + k * part,
                                              step_of_level(level), impulse_);
            for (std::size_t level = 0; level < dofs_.size(); ++level)
                is_node(level, k + 1) ? reach_node(level) : static_cast<void>(elapsed_[level] += part);
        }
    }

    [[nodiscard]] double step_of_level(std::size_t level) const { return this->dt_ / steps_.parts[level]; }
    /// Whether a step of this level begins after k parts of the finest.
    [[nodiscard]] bool is_node(std::size_t level, std::int32_t k) const {
        return k % (steps_.parts.back() / steps_.parts[level]) == 0;
    }
    void reach_node(std::size_t level) {
        const double flown = elapsed_[level] + step_of_level(dofs_.size() - 1);  // as FreeFlight::at has it, to the last bit
        for (const std::size_t i : dofs_[level]) {
            this->q_[i] += flown * velocity_[i];
            const double p = this->p_before_[i] + 2.0 * impulse_[i];
            this->p_before_[i] = this->p_after_[i];
            this->p_after_[i] = p;
            impulse_[i] = 0.0;
        }
        elapsed_[level] = 0.0;
        set_velocity(dofs_[level]);
    }
    void set_velocity(std::span<const std::size_t> dofs) {
        const std::span<const double> inverse_mass = this->system_.inverse_mass();
        for (const std::size_t i : dofs) velocity_[i] = inverse_mass[i] * this->p_after_[i];
    }
    void momenta_changed() {
        for (const auto& dofs : dofs_) set_velocity(dofs);
    }
    [[nodiscard]] double conserved_energy(double potential) const { return this->staggered_kinetic_energy() + potential; }

    LocalSteps steps_;
    std::vector<std::vector<std::size_t>> dofs_;  // of each level
    std::vector<double> velocity_;                // M^-1 p^{k+1/2}
    std::vector<double> impulse_;
    std::vector<double> elapsed_;  // since the last node of each level; 0 at common nodes [s]
};

}  // namespace abut::dynamics
