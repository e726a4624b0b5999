#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

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

    /// One step of the integrator's dt, or a shorter one to the first event within it: where a function is 0 up to 1e-14 of
    /// its own values at the ends of the whole step, or the step is known to 1e-15 of dt. The integrator keeps its dt.
    /// Throws Diverged where a function is not a number; the state is then that before the step.
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

    /// An interval of steps in which the least function becomes negative, with its values over their scales.
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
        const std::vector<double> at_start = events_.values(start.q);
        take(start, start.dt);
        const std::vector<double> at_end = events_.values(integrator_.q());
        if (std::ranges::none_of(at_end, [](double value) { return value < 0.0; })) return {start.dt, 0, 1};
        return find(start, detail::event_scales(at_start, at_end));
    }
    /// The first event, after a whole step that has gone beyond one.
    LandedStep find(const IntegratorState& start, const std::vector<double>& scales) {
        const double dt = start.dt;
        Bracket bracket{0.0, dt, std::max(events_.least(start.q, scales), 0.0), events_.least(integrator_.q(), scales)};
        for (int trials = 2;; ++trials) {
            const bool is_narrow = bracket.width() <= width_tolerance * dt;
            const double taken = is_narrow ? bracket.high : trials % 3 == 0 ? bracket.middle() : bracket.secant();
            take(start, taken);
            const double value = events_.least(integrator_.q(), scales);
            if (is_narrow || std::abs(value) <= value_tolerance) return land(dt, taken, scales, trials);
            (value < 0.0 ? bracket.high : bracket.low) = taken;
            (value < 0.0 ? bracket.at_high : bracket.at_low) = value;
        }
    }
    void take(const IntegratorState& start, double dt) {
        integrator_.restore(start);
        integrator_.step(dt, StepChange::keep);
    }
    LandedStep land(double dt, double taken, const std::vector<double>& scales, int trials) {
        const std::size_t turned = events_.turn(integrator_.q(), scales, value_tolerance);
        integrator_.set_step(dt, StepChange::keep);
        return {taken, turned, trials};
    }

    Composed<S>& integrator_;
    Events events_;
};

}  // namespace abut::dynamics
