#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/ranks.hpp"
#include "abut/dynamics/system.hpp"

namespace abut::dynamics {

/// Effect of a new time step on the half-step momenta. docs/integrators.md, Variable steps.
enum class StepChange {
    /// They stay: what the scheme conserves stays exact, but they are then not centred about their node. With MEMM, and with
    /// local steps, only for slow and smooth changes: alternating or irregular steps solve another equation and feed the
    /// parasitic mode, which then grows exponentially at any size of step, and H~ does not notice.
    keep,
    restart,  ///< they are rebuilt from p^n with the new dt: accurate, and H~ jumps by O(dt^2), reported
};

/// All that the next steps of a scheme depend on, except its system.
struct IntegratorState {
    std::vector<double> q;         ///< q^n
    std::vector<double> p_before;  ///< p^{n-1/2}
    std::vector<double> p_after;   ///< p^{n+1/2}
    double dt = 0.0;               ///< [s]
    double time = 0.0;             ///< [s]
    std::int64_t steps = 0;
    double restart_jumps = 0.0;     ///< [J]
    std::vector<double> of_scheme;  ///< what only this scheme knows
};

namespace detail {
/// Throw BadInput.
void check_step(double dt);
void check_state(const IntegratorState& state, std::size_t size, std::size_t of_scheme);
void check_start(std::size_t size, std::span<const double> q, std::span<const double> p);
[[noreturn]] void refuse_constraints();
}  // namespace detail

/// Part that all schemes share: positions q^n, momenta p^{n-1/2} and p^{n+1/2} around them, start-up, changes of dt,
/// energies.
///
/// A Scheme derives from it, calls `begin` in its constructor, and has
///     void start(span p)                  sets p_before_ and p_after_ (and what else it keeps) from p^n at q_, for dt_
///     void advance()                      from q_ at time_ to the next node
///     double conserved_energy(double V)   the energy that it conserves, V being V(q_) [J]
///     has_half_steps                      whether its momenta are at half steps
///     takes_constraints                whether it runs a ConstrainedSystem that has constraints
///     takes_after_step, takes_node_restart    whether `set_after_step` and `set_node_restart` are offered
///     for_one_rank (optional)     where it is made for one rank alone: its name in the message that refuses others
/// and, if it keeps numbers beside those of this class, `of_scheme()` that returns them and `set_of_scheme(span)`; if
/// it keeps what follows from the momenta, `momenta_changed()`.
/// Static polymorphism: no virtual calls. After an exception from `step`, except for a bad dt, the run is over unless the
/// scheme says more.
template <class Scheme, System S>
class Integrator {
public:
    /// Called at the end of each step with p^{n+1/2} and p^{n+3/2} at q^{n+1}; may change the latter (a filter).
    using AfterStep = std::function<void(std::span<const double> q, double dt, std::span<const double> p_before,
                                         std::span<double> p_after)>;
    /// Offered by schemes that keep nothing else which depends on p^{n+3/2}.
    void set_after_step(AfterStep after_step) requires(Scheme::takes_after_step) { after_step_ = std::move(after_step); }

    /// Called after that; may change both (a restart).
    using NodeRestart =
        std::function<void(std::span<const double> q, double dt, std::span<double> p_before, std::span<double> p_after)>;
    /// Offered by schemes whose next step depends on both.
    void set_node_restart(NodeRestart restart) requires(Scheme::takes_node_restart) { node_restart_ = std::move(restart); }

    /// One step of the present dt.
    void step() {
        scheme().advance();
        time_ += dt_;
        ++steps_;
        if (after_step_) after_step_(q_, dt_, p_before_, p_after_);
        if (node_restart_) node_restart_(q_, dt_, p_before_, p_after_);
    }

    /// One step of a given dt (an outer solver dictates it). Throws BadInput, and stays as it is, if dt is not
    /// > 0 and finite.
    void step(double dt, StepChange change) {
        set_step(dt, change);
        step();
    }

    /// Sets dt without a step: the steps that follow have this dt.
    void set_step(double dt, StepChange change) {
        detail::check_step(dt);
        const bool changed = dt != dt_;
        dt_ = dt;
        if (changed && change == StepChange::restart) restart();
        if constexpr (ConstrainedSystem<S>)
            if (changed && change == StepChange::keep) system_.constrain_along(q_, dt_, p_after_);
    }

    /// Brings all to rest where it is, p^n = 0. Time goes on.
    void bring_to_rest() { scheme().start(std::vector<double>(q_.size(), 0.0)); }

    /// Turns the motion round: a system whose force depends on q alone follows the same path back, up to rounding. Time
    /// goes on.
    void reverse() {
        std::swap(p_before_, p_after_);
        for (auto* momenta : {&p_before_, &p_after_})
            for (double& p : *momenta) p = -p;
        if constexpr (requires(Scheme & s) { s.momenta_changed(); }) scheme().momenta_changed();
        if constexpr (requires(Scheme & s) { s.turn(); }) scheme().turn();
    }

    /// Between two steps.
    [[nodiscard]] IntegratorState state() const {
        IntegratorState state{q_, p_before_, p_after_, dt_, time_, steps_, restart_jumps_, {}};
        if constexpr (requires(const Scheme& s) { s.of_scheme(); })
            state.of_scheme = static_cast<const Scheme&>(*this).of_scheme();
        return state;
    }
    /// Goes on from there: with a system that is restored, too, the next steps have the same bits. Throws BadInput, and
    /// stays as it is, for a state of another size or with a value that is not finite.
    void restore(IntegratorState state) {
        constexpr bool keeps_more = requires(const Scheme& s) { s.of_scheme(); };
        std::size_t n_more = 0;
        if constexpr (keeps_more) n_more = scheme().of_scheme().size();
        detail::check_state(state, q_.size(), n_more);
        q_ = std::move(state.q);
        p_before_ = std::move(state.p_before);
        p_after_ = std::move(state.p_after);
        dt_ = state.dt;
        time_ = state.time;
        steps_ = state.steps;
        restart_jumps_ = state.restart_jumps;
        if constexpr (keeps_more) scheme().set_of_scheme(state.of_scheme);
        if constexpr (requires(Scheme & s) { s.momenta_changed(); }) scheme().momenta_changed();
    }

    [[nodiscard]] const Ranks& ranks() const { return ranks_of(system_); }  ///< of the system
    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] double dt() const { return dt_; }
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    /// Views of the present state, valid until the next step: schemes swap their arrays.
    [[nodiscard]] std::span<const double> q() const { return q_; }
    [[nodiscard]] std::span<const double> p_before() const { return p_before_; }  ///< p^{n-1/2}
    [[nodiscard]] std::span<const double> p_after() const { return p_after_; }    ///< p^{n+1/2}

    /// The energy that the scheme conserves, at the present node [J]; work from outside is not taken out.
    [[nodiscard]] double pseudo_energy() { return pseudo_energy(system_.potential(q_)); }
    /// Pseudo-energy where V at the present node is known.
    [[nodiscard]] double pseudo_energy(double potential) { return scheme().conserved_energy(potential); }
    /// 1/2 p . M^-1 p with p^n = (p^{n-1/2} + p^{n+1/2})/2 [J]
    [[nodiscard]] double kinetic_energy() const { return staggered_kinetic_energy() + energy_excess(); }
    /// H^n = kinetic energy + V [J]
    [[nodiscard]] double energy() { return kinetic_energy() + system_.potential(q_); }
    /// 1/2 p^{n-1/2} . M^-1 p^{n+1/2} [J]
    [[nodiscard]] double staggered_kinetic_energy() const { return 0.5 * mass_product(p_before_, p_after_); }
    /// The kinetic energy less the staggered one, 1/8 |p^{n+1/2} - p^{n-1/2}|^2_{M^-1} >= 0 [J]: with MEMM it is H - H~.
    [[nodiscard]] double energy_excess() const {
        add_scaled(p_after_, -1.0, p_before_, scratch_);
        return 0.125 * mass_product(scratch_, scratch_);
    }
    /// e^n = p^{n+1/2} - p^{n-1/2} - dt F(q^n) [N s]: the alternating mode that a two-step scheme may carry undamped. Zero
    /// for schemes without half-step momenta.
    void parasitic_momentum(std::span<double> e) {
        if constexpr (!Scheme::has_half_steps) return std::fill(e.begin(), e.end(), 0.0);
        system_.force(q_, e);
        subtract_from_jump(e);
    }
    /// V at the present node [J], and e as `parasitic_momentum` gives it.
    [[nodiscard]] double potential_and_parasitic_momentum(std::span<double> e) {
        if constexpr (Scheme::has_half_steps && requires { system_.potential_and_force(q_, e); }) {
            const double potential = system_.potential_and_force(q_, e);
            subtract_from_jump(e);
            return potential;
        } else {
            const double potential = system_.potential(q_);
            parasitic_momentum(e);
            return potential;
        }
    }
    /// Sum of all jumps of the pseudo-energy that restarts caused [J].
    [[nodiscard]] double restart_jumps() const { return restart_jumps_; }

protected:
    Integrator(S& system, std::vector<double> q, double dt) : system_(system), q_(std::move(q)), dt_(dt) {}

    /// Throws BadInput if dt is not > 0 and finite, or if sizes disagree or a value is not finite.
    void begin(std::span<const double> p) {
        detail::check_step(dt_);
        if constexpr (ConstrainedSystem<S> && !Scheme::takes_constraints)
            if (system_.has_constraints()) detail::refuse_constraints();
        if constexpr (requires { Scheme::for_one_rank; }) refuse_ranks(ranks(), {{Scheme::for_one_rank}});
        agreed(ranks(), [&] { detail::check_start(system_.size(), q_, p); });
        for (auto* array : {&p_before_, &p_after_, &q_next_, &force_, &scratch_}) array->resize(q_.size());
        scheme().start(p);
    }

    /// p^{-+1/2} = p -+ dt/2 F(q), F with what acts on the rates of p; those of p^{-1/2} are the last ones afterwards.
    void split_momentum(std::span<const double> p) {
        if constexpr (RateSystem<S>) system_.set_rates(q_, p);
        system_.force(q_, force_);
        for (std::size_t i = 0; i < q_.size(); ++i) {
            p_before_[i] = p[i] - 0.5 * step_of(i) * force_[i];
            p_after_[i] = p[i] + 0.5 * step_of(i) * force_[i];
        }
        if constexpr (ConstrainedSystem<S>) {
            system_.constrain_at(q_, -dt_, p_before_);
            system_.constrain_at(q_, dt_, p_after_);
        }
        if constexpr (RateSystem<S>) system_.set_rates(q_, p_before_);
    }
    /// a . M^-1 b
    [[nodiscard]] double mass_product(std::span<const double> a, std::span<const double> b) const {
        if constexpr (requires { system_.ranks(); })
            return mass_product_over(system_.ranks(), a, system_.inverse_mass(), b);
        else
            return dynamics::mass_product(a, system_.inverse_mass(), b);
    }

    S& system_;
    std::vector<double> q_;
    std::vector<double> p_before_;
    std::vector<double> p_after_;
    std::vector<double> q_next_;  // work arrays
    std::vector<double> force_;
    double dt_;
    double time_ = 0.0;

private:
    Scheme& scheme() { return static_cast<Scheme&>(*this); }
    /// Makes e of the force at the present node.
    void subtract_from_jump(std::span<double> force) {
        add_scaled(p_after_, -1.0, p_before_, scratch_);
        for (std::size_t i = 0; i < q_.size(); ++i) force[i] = scratch_[i] - step_of(i) * force[i];
    }
    double step_of(std::size_t i) const {
        if constexpr (requires(const Scheme& s) { s.local_step(i); })
            return static_cast<const Scheme&>(*this).local_step(i);
        else
            return dt_;
    }

    void restart() {
        const double before = scheme().conserved_energy(0.0);  // V does not change
        std::vector<double> p(q_.size());
        for (std::size_t i = 0; i < p.size(); ++i) p[i] = 0.5 * (p_before_[i] + p_after_[i]);
        scheme().start(p);
        restart_jumps_ += scheme().conserved_energy(0.0) - before;
    }

    mutable std::vector<double> scratch_;
    AfterStep after_step_;
    NodeRestart node_restart_;
    double restart_jumps_ = 0.0;
    std::int64_t steps_ = 0;
};

}  // namespace abut::dynamics
