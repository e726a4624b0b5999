#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/ranks.hpp"

namespace abut::dynamics {

/// Lengths of the steps that a run has taken so far.
struct PairsReport {
    double longest = 0.0;      ///< [s]
    std::int64_t changes = 0;  ///< steps that differ by more than 10 % from the last one counted
    /// Whether upper modes may grow, as they do under steps that vary: `longest` is above a quarter of the stable step,
    /// omega d > 0.5, and there were more than ten changes. H~ does not see it. Take OwnClock, or shorter steps.
    bool may_grow = false;
};

namespace detail {
/// Throws BadInput unless it is > 0, which may be infinite.
void check_stable_step(double stable_step);
/// Throws BadInput: `what` the system has, in the words of the user.
[[noreturn]] void refuse_pairs(const char* what);
/// Throws BadInput for a saved state without the length of the path that is held back, or with one < 0, or with one that is
/// not 0 and not the step of the integrator.
void check_held(std::span<const double> of_scheme, double dt);

/// Counts steps for a report.
class StepChanges {
public:
    explicit StepChanges(double stable_step) : stable_step_(stable_step) {}
    void count(double d);
    [[nodiscard]] const PairsReport& report() const { return report_; }

private:
    double stable_step_;
    double counted_ = 0.0;  // the step that the next ones are compared with
    PairsReport report_;
};
}  // namespace detail

/// MEMM in pairs of sub-steps, for a system of one's own whose steps vary: order 2, and H~ is exact for any sequence of
/// them. docs/integrators.md, Variable steps. Two copies of the momentum, a and b, start as p:
///
///     A(d/4) B(d/2) A(d/4),  A(s): q += s M^-1 b, a += 2 s mean of F over that path,  B(s): the same with a and b exchanged
///
/// The last A of a step and the first of the next have the same b, so that both are one straight path: its kick is held back
/// until the next d is known, and q at every t_n costs 2 forces. Never A B A and B A B in turn: for a constant d that is
/// stable for omega d < 2.47 instead of 4. Upper modes grow under steps that vary, whatever their size; see PairsReport.
template <System S>
class Pairs {
public:
    /// Starts from q and p at the same time. `stable_step` is 2/omega_max [s], as of `dynamics::stable_step`, infinite where
    /// nothing is known: then `may_grow` stays false. The system must outlive it. Throws BadInput if that is not > 0, the
    /// sizes disagree, a value is not finite, or the system has constraints, forces on rates (as every solid), several
    /// ranks, or no such mean.
    Pairs(S& system, std::vector<double> q, std::span<const double> p, double stable_step, PathMean mean = PathMean::system)
        : system_(checked(system, stable_step)), memm_(system, std::move(q), p, first_step, mean), changes_(stable_step) {
        IntegratorState state = memm_.state();
        state.p_before.assign(p.begin(), p.end());
        state.p_after = state.p_before;
        memm_.restore(std::move(state));
    }

    /// Goes on by d [s]. Throws BadInput unless d is > 0 and finite. Where a step throws, for d or as a mean force does, all
    /// stays as it is, except a memory of the system itself.
    void step(double d) {
        step(d, [](double, double) {});
    }
    /// Goes on by d under loads from outside: `load(before, now)` is called before each of the two mean forces, which acts
    /// for `before` seconds under the loads of the last step and for `now` seconds under those of this one. The system then
    /// has to have the mean of both. Where `load` throws, all stays as it is, too.
    template <class Load>
    void step(double d, const Load& load) {
        detail::check_step(d);
        const double quarter = 0.25 * d;
        or_as_before([&] {
            load(held_, quarter);
            memm_.step(held_ + quarter, StepChange::keep);
            load(0.0, 2.0 * quarter);
            memm_.step(2.0 * quarter, StepChange::keep);
            memm_.set_step(quarter, StepChange::keep);
        });
        held_ = quarter;
        ++steps_;
        changes_.count(d);
    }

    [[nodiscard]] double time() const { return memm_.time() + held_; }  ///< [s]
    [[nodiscard]] std::int64_t steps() const { return steps_; }
    [[nodiscard]] const PairsReport& report() const { return changes_.report(); }
    /// q at this time [m]. Valid until the next step.
    [[nodiscard]] std::span<const double> q() { return held_ > 0.0 ? memm_.next_q() : memm_.q(); }

    /// All at this time, with the kick that is held back: a and b are `p_before` and `p_after`, p = (a + b)/2, and H~ =
    /// 1/2 a . M^-1 b + V(q). 1 force; what follows does not depend on it, also where that throws.
    [[nodiscard]] IntegratorState synchronised() requires(!FollowedSystem<S>) {
        if (held_ == 0.0) return memm_.state();
        IntegratorState state;
        or_as_before([&] {
            memm_.step();
            state = memm_.state();
        });
        memm_.restore(before_);
        std::swap(state.p_before, state.p_after);
        state.steps = steps_;
        return state;
    }
    /// H~ at this time [J]; work from outside is not taken out. 1 force.
    [[nodiscard]] double pseudo_energy() requires(!FollowedSystem<S>) {
        const IntegratorState state = synchronised();
        return 0.5 * mass_product(state.p_before, system_.inverse_mass(), state.p_after) + system_.potential(state.q);
    }

    /// Between two steps, with the kick still held back.
    [[nodiscard]] IntegratorState state() const {
        IntegratorState state = memm_.state();
        state.steps = steps_;
        state.of_scheme = {held_};
        return state;
    }
    /// Goes on from there, bitwise identical; the report goes on from what it is. Throws BadInput, and stays as it is, for a
    /// state of another size, with a value that is not finite, or whose dt is not the length of the path that is held back.
    void restore(IntegratorState state) {
        detail::check_held(state.of_scheme, state.dt);
        const double held = state.of_scheme.front();
        const std::int64_t steps = state.steps;
        state.of_scheme.clear();
        memm_.restore(std::move(state));
        held_ = held;
        steps_ = steps;
    }

private:
    static constexpr double first_step = 1.0;  // [s] of the integrator at its start, where no step is known

    static S& checked(S& system, double stable_step) {
        detail::check_stable_step(stable_step);
        refuse_ranks(ranks_of(system), {{"pairs of sub-steps"}});
        if constexpr (RateSystem<S>) detail::refuse_pairs("forces on rates (set_rates), which the last step decides");
        if constexpr (ConstrainedSystem<S>)
            if (system.has_constraints()) detail::refuse_pairs("constraints, whose impulses are those of a step");
        return system;
    }

    /// Does it, or throws with the integrator as it was. No allocation after the first time.
    template <class Action>
    void or_as_before(const Action& action) {
        remember();
        try {
            action();
        } catch (...) {
            memm_.restore(before_);
            throw;
        }
    }
    void remember() {
        before_.q.assign(memm_.q().begin(), memm_.q().end());
        before_.p_before.assign(memm_.p_before().begin(), memm_.p_before().end());
        before_.p_after.assign(memm_.p_after().begin(), memm_.p_after().end());
        before_.dt = memm_.dt();
        before_.time = memm_.time();
        before_.steps = memm_.steps();
        before_.restart_jumps = memm_.restart_jumps();
    }

    S& system_;
    Memm<S> memm_;            // at the start of the path that is held back, with its length as dt
    double held_ = 0.0;       // length of that path [s]
    IntegratorState before_;  // of memm_, before what may throw
    std::int64_t steps_ = 0;
    detail::StepChanges changes_;
};

}  // namespace abut::dynamics
