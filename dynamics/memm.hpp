#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "abut/dynamics/system.hpp"

namespace abut::dynamics {

/// What a new time step does to the half-step momenta. docs/method.md, Time.
enum class StepChange {
    /// H~ stays exact, but p^{n+3/2} and p^{n-1/2} are then not 2 dt apart. Only for slow and smooth changes:
    /// alternating or irregular steps feed the parasitic mode, which then grows exponentially at any size of step, and H~
    /// does not notice.
    keep,
    restart,  ///< the half-step momenta are made anew from p^n with the new dt: accurate, and H~ jumps by O(dt^2), reported
};

namespace detail {
/// result = a + s M^-1 p and result = a + s f, element by element.
void add_scaled_velocity(std::span<const double> a, double s, std::span<const double> inverse_mass,
                         std::span<const double> p, std::span<double> result);
void add_scaled(std::span<const double> a, double s, std::span<const double> f, std::span<double> result);
/// 1/2 a . M^-1 b
[[nodiscard]] double half_product(std::span<const double> a, std::span<const double> inverse_mass,
                                  std::span<const double> b);
[[noreturn]] void refuse_step(double dt);
}  // namespace detail

/// The explicit pseudo-energy conserving scheme MEMM. docs/method.md, Time.
///
///     q^{n+1}   = q^n + dt M^-1 p^{n+1/2}
///     p^{n+3/2} = p^{n-1/2} + 2 dt mean of F over the straight way from q^n to q^{n+1}
///
/// conserves H~^n = 1/2 p^{n-1/2} . M^-1 p^{n+1/2} + V(q^n), less the work from outside, whatever dt. It is stable below the
/// stable step only, and H~ alone does not tell: print `energy_excess` and `parasitic` beside it.
template <System S>
class Memm {
public:
    /// Called at the end of each step with p^{n+1/2} and p^{n+3/2} at q^{n+1}; may change the latter (a filter).
    using AfterStep = std::function<void(std::span<const double> q, double dt, std::span<const double> p_before,
                                         std::span<double> p_after)>;

    /// Starts from q and p at the same time, p^{-+1/2} = p -+ dt/2 F(q). The system must outlive the integrator.
    /// Throws std::invalid_argument if dt is not > 0 and finite or the sizes disagree.
    Memm(S& system, std::vector<double> q, std::span<const double> p, double dt)
        : system_(system), q_(std::move(q)), dt_(dt) {
        if (!(dt > 0.0) || !std::isfinite(dt)) detail::refuse_step(dt);
        if (q_.size() != system.size() || p.size() != system.size())
            throw std::invalid_argument("MEMM: the state has " + std::to_string(q_.size()) + " positions and " +
                                        std::to_string(p.size()) + " momenta, the system " + std::to_string(system.size()) +
                                        " degrees of freedom.");
        for (auto* array : {&q_next_, &force_, &p_before_, &p_after_}) array->resize(q_.size());
        split_momentum(p);
    }

    void set_after_step(AfterStep after_step) { after_step_ = std::move(after_step); }

    /// One step of the present dt.
    void step() {
        detail::add_scaled_velocity(q_, dt_, system_.inverse_mass(), p_after_, q_next_);
        system_.mean_force(q_, q_next_, time_, dt_, force_);
        detail::add_scaled(p_before_, 2.0 * dt_, force_, p_before_);
        std::swap(p_before_, p_after_);
        std::swap(q_, q_next_);
        time_ += dt_;
        ++steps_;
        if (after_step_) after_step_(q_, dt_, p_before_, p_after_);
    }

    /// One step of a given dt (an outer solver dictates it).
    void step(double dt, StepChange change) {
        if (!(dt > 0.0) || !std::isfinite(dt)) detail::refuse_step(dt);
        if (dt != dt_ && change == StepChange::restart) restart(dt);
        dt_ = dt;
        step();
    }

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] double dt() const { return dt_; }
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    [[nodiscard]] std::span<const double> q() const { return q_; }
    [[nodiscard]] std::span<const double> p_before() const { return p_before_; }  ///< p^{n-1/2}
    [[nodiscard]] std::span<const double> p_after() const { return p_after_; }    ///< p^{n+1/2}

    [[nodiscard]] double pseudo_kinetic_energy() const {
        return detail::half_product(p_before_, system_.inverse_mass(), p_after_);
    }
    /// H~^n [J]; work from outside is not taken out.
    [[nodiscard]] double pseudo_energy() { return pseudo_kinetic_energy() + system_.potential(q_); }
    /// H - H~ = 1/8 |p^{n+1/2} - p^{n-1/2}|^2_{M^-1} >= 0 [J]: the size of what H~ does not see.
    [[nodiscard]] double energy_excess() const {
        detail::add_scaled(p_after_, -1.0, p_before_, scratch());
        return 0.25 * detail::half_product(scratch_, system_.inverse_mass(), scratch_);
    }
    /// e^n = p^{n+1/2} - p^{n-1/2} - dt F(q^n): the alternating mode that the two-step scheme carries undamped [N s].
    void parasitic_momentum(std::span<double> e) {
        system_.force(q_, e);
        detail::add_scaled(p_after_, -1.0, p_before_, scratch());
        detail::add_scaled(scratch_, -dt_, e, e);
    }
    /// Sum of all jumps of H~ that restarts caused [J].
    [[nodiscard]] double restart_jumps() const { return restart_jumps_; }

private:
    void split_momentum(std::span<const double> p) {
        system_.force(q_, force_);
        detail::add_scaled(p, -0.5 * dt_, force_, p_before_);
        detail::add_scaled(p, 0.5 * dt_, force_, p_after_);
    }

    void restart(double dt) {
        const double before = pseudo_kinetic_energy();
        std::vector<double> p(q_.size());
        detail::add_scaled(p_before_, 1.0, p_after_, p);
        for (double& value : p) value *= 0.5;
        dt_ = dt;
        split_momentum(p);
        restart_jumps_ += pseudo_kinetic_energy() - before;
    }

    std::span<double> scratch() const {
        scratch_.resize(q_.size());
        return scratch_;
    }

    S& system_;
    std::vector<double> q_;
    std::vector<double> q_next_;
    std::vector<double> p_before_;
    std::vector<double> p_after_;
    std::vector<double> force_;
    mutable std::vector<double> scratch_;
    AfterStep after_step_;
    double dt_;
    double time_ = 0.0;
    double restart_jumps_ = 0.0;
    std::int64_t steps_ = 0;
};

}  // namespace abut::dynamics
