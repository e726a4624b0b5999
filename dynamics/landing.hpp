#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "abut/dynamics/composed.hpp"
#include "abut/dynamics/events.hpp"

namespace abut::dynamics {

/// A step that may have ended at an event.
struct LandedStep {
    double dt;           ///< its length [s]
    std::size_t events;  ///< how many sides have turned at its end
    int trials;          ///< steps that were taken to find it
};

/// Steps of a composition that end at events: where forces have a kink the order is 3 at most, unless steps end there.
/// docs/integrators.md, Higher orders. Two roots of one function within a step are not seen: the order is 3 there.
template <System S>
class Landing {
public:
    /// The integrator must outlive it.
    Landing(Composed<S>& integrator, Events events) : integrator_(integrator), events_(std::move(events)) {}

    /// One step of the integrator's dt, or a shorter one to the first event within it: where the least function is 0 up to
    /// 1e-14 of its largest value, or the step is known to 1e-15 of dt. The integrator keeps its dt. Throws Diverged where
    /// a function is not a number; the state is then that before the step.
    LandedStep step() {
        const IntegratorState start = integrator_.state();
        try {
            return step_from(start);
        } catch (...) {
            integrator_.restore(start);
            throw;
        }
    }
    [[nodiscard]] const Events& events() const { return events_; }  ///< their sides belong to a saved state

private:
    static constexpr double value_tolerance = 1e-14, width_tolerance = 1e-15;

    /// An interval of steps in which the least function becomes negative.
    struct Bracket {
        double low, high, at_low, at_high;

        [[nodiscard]] double width() const { return high - low; }
        [[nodiscard]] double middle() const { return low + 0.5 * width(); }
        /// Root of the straight line; the middle where that lies at an end.
        [[nodiscard]] double secant() const {
            const double x = low + width() * at_low / (at_low - at_high);
            return x > low && x < high ? x : middle();
        }
    };

    LandedStep step_from(const IntegratorState& start) {
        const double dt = start.dt, at_start = events_.least(start.q);
        const double at_end = least_after(start, dt);
        if (!(at_end < 0.0)) return {dt, 0, 1};
        const double tolerance = value_tolerance * std::max(std::abs(at_start), std::abs(at_end));
        Bracket bracket{0.0, dt, std::max(at_start, 0.0), at_end};
        double taken = dt;
        for (int trials = 2;; ++trials) {
            const bool is_narrow = bracket.width() <= width_tolerance * dt;
            taken = is_narrow ? bracket.high : trials % 3 == 0 ? bracket.middle() : bracket.secant();
            const double value = least_after(start, taken);
            if (is_narrow || std::abs(value) <= tolerance) return land(dt, taken, tolerance, trials);
            (value < 0.0 ? bracket.high : bracket.low) = taken;
            (value < 0.0 ? bracket.at_high : bracket.at_low) = value;
        }
    }
    double least_after(const IntegratorState& start, double dt) {
        integrator_.restore(start);
        integrator_.step(dt, StepChange::keep);
        return events_.least(integrator_.q());
    }
    LandedStep land(double dt, double taken, double tolerance, int trials) {
        const std::size_t turned = events_.turn(integrator_.q(), tolerance);
        integrator_.set_step(dt, StepChange::keep);
        return {taken, turned, trials};
    }

    Composed<S>& integrator_;
    Events events_;
};

}  // namespace abut::dynamics
