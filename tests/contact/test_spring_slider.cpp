#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "abut/contact/friction.hpp"
#include "abut/contact/law/friction_step.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using contact::Along;
using contact::Friction;
using contact::StickState;

namespace {

/// A unit mass on a belt that moves at `speed`, held by a unit spring, and pressed on by a unit force: it sticks by K, is taken along
/// until the spring pulls with mu_rest, slides back against mu_sliding, and sticks again.
struct Slider {
    Friction law{.coefficient = 0.5, .sliding_coefficient = 0.3, .decay_speed = 1e-2};
    double speed = 0.1;        ///< of the belt [m/s]
    double stiffness = 200.0;  ///< K of sticking [N/m]; that of the spring is 1
    double time = 60.0;        ///< [s]

    [[nodiscard]] double limit(const Along<1>& motion, double dt) const {
        return coefficient_of(law, {.speed = motion.norm() / dt, .slid = 0.0, .pressure = 1.0});
    }
    [[nodiscard]] double creep(double dt) const { return dt / (2.0 * law.relaxation_time); }
};

/// What a run shows.
struct Stroke {
    double furthest = 0.0;  ///< of the spring after the first slip [m]
    double nearest = 1e9;   ///< the least after it [m]
    double period = 0.0;    ///< mean time between two slips [s]
    double balance = 0.0;   ///< |H~ - H~0 + D - W| over W at the end
};

/// Looks at positions of a run.
class Watch {
public:
    void at(double t, double x, bool slides) {
        if (t > 0.0 && slides && !slid_ && t - begin_ > 1.0) {
            if (n_++ == 0) first_ = t;
            begin_ = t;
        }
        slid_ = slides;
        if (n_ > 1) found_.furthest = std::max(found_.furthest, x), found_.nearest = std::min(found_.nearest, x);
    }
    [[nodiscard]] Stroke found() const {
        Stroke found = found_;
        found.period = (begin_ - first_) / (n_ - 1);
        return found;
    }

private:
    Stroke found_;
    int n_ = 0;
    double first_ = 0.0, begin_ = -10.0;
    bool slid_ = false;
};

/// MEMM with the mean force of a step.
template <class Look>
Stroke by_memm(const Slider& slider, double dt, const Look& look) {
    StickState<1> state{.stiffness = slider.stiffness};
    double x = 0.0, before = slider.speed, after = slider.speed, dissipated = 0.0, work = 0.0, h_0 = 0.0, off = 0.0;
    Watch watch;
    for (double t = 0.0; t < slider.time; t += dt) {
        const double h = 0.5 * before * after + 0.5 * x * x + state.energy();
        if (t == 0.0) h_0 = h;
        off = std::max(off, std::abs(h - h_0 + dissipated - work));
        const double x_1 = x + dt * after;
        const Along<1> motion(slider.speed * dt - dt * after);
        const auto step = contact::take_mean_step<1>(state, motion, slider.limit(motion, dt), slider.creep(dt));
        dissipated += step.dissipated;
        work += step.force[0] * slider.speed * dt;
        before += 2.0 * dt * (step.force[0] - 0.5 * (x + x_1));
        std::swap(before, after);
        x = x_1;
        watch.at(t + dt, x, step.slides());
        look(t + dt, x);
    }
    Stroke found = watch.found();
    found.balance = off / work;
    return found;
}

/// The reference: velocity Verlet with the force at the end of a step.
template <class Look>
Stroke by_verlet(const Slider& slider, double dt, const Look& look) {
    double x = 0.0, v = slider.speed, force = 0.0, stretch = 0.0;
    Watch watch;
    for (double t = 0.0; t < slider.time; t += dt) {
        const double half = v + 0.5 * dt * force;
        x += dt * half;
        const Along<1> motion((slider.speed - half) * dt);
        // the spring by which it sticks, cut at the limit
        const double tried = ((1.0 - slider.creep(dt)) * stretch + motion[0]) / (1.0 + slider.creep(dt));
        const double largest = slider.limit(motion, dt) / slider.stiffness;
        stretch = std::clamp(tried, -largest, largest);
        force = slider.stiffness * stretch - x;
        v = half + 0.5 * dt * force;
        watch.at(t + dt, x, tried != stretch);
        look(t + dt, x);
    }
    return watch.found();
}

/// x at t of a slider with a constant mu that starts with the belt, in closed form while it sticks, and while it slides until it
/// is as fast as the belt: m = k = N = 1.
class ClosedForm {
public:
    explicit ClosedForm(const Slider& slider) : slider_(slider), frequency_(std::sqrt(1.0 + slider.stiffness)) {
        while (slider.stiffness * (slider.speed * begin_ - sticking(begin_)) < slider.law.coefficient) begin_ += 1e-6;
    }
    /// Of sliding [s], one swing later at the latest.
    [[nodiscard]] double end() const {
        double t = begin_ + 1e-3;
        while (sliding_speed(t) < slider_.speed && t < begin_ + 2.0 * std::numbers::pi) t += 1e-3;
        return t;
    }
    [[nodiscard]] double at(double t) const { return t < begin_ ? sticking(t) : sliding(t); }

private:
    [[nodiscard]] double share() const { return slider_.stiffness * slider_.speed / (1.0 + slider_.stiffness); }
    [[nodiscard]] double sticking(double t) const {
        return share() * t + (slider_.speed - share()) * std::sin(frequency_ * t) / frequency_;
    }
    [[nodiscard]] double first_speed() const { return share() + (slider_.speed - share()) * std::cos(frequency_ * begin_); }
    [[nodiscard]] double sliding(double t) const {
        const double mu = slider_.law.coefficient, by = t - begin_;
        return mu + (sticking(begin_) - mu) * std::cos(by) + first_speed() * std::sin(by);
    }
    [[nodiscard]] double sliding_speed(double t) const {
        const double by = t - begin_;
        return (slider_.law.coefficient - sticking(begin_)) * std::sin(by) + first_speed() * std::cos(by);
    }

    Slider slider_;
    double frequency_, begin_ = 0.0;
};

/// Largest distance of a scheme from the closed form, until the mass would stick again [m].
double distance_from_closed_form(const Slider& slider, double dt, bool memm) {
    const ClosedForm closed(slider);
    double worst = 0.0;
    const auto look = [&](double t, double x) {
        if (t < closed.end()) raise(worst, std::abs(x - closed.at(t)));
    };
    if (memm)
        by_memm(slider, dt, look);
    else
        by_verlet(slider, dt, look);
    return worst;
}

}  // namespace

TEST_CASE(
    "a slider on a spring that sticks and slides follows its closed form, to the second order in the step, as under Verlet",
    "[contact][friction]") {
    const Slider slider{.law = {.coefficient = 0.5}, .stiffness = 100.0, .time = 11.4};
    for (const bool memm : {true, false}) {
        const double coarse = distance_from_closed_form(slider, 1e-2, memm),
                     fine = distance_from_closed_form(slider, 5e-3, memm);
        CHECK(coarse < 1e-4 * slider.law.coefficient);
        CHECK(fine == Approx(coarse / 4.0).epsilon(0.1));
    }
}

TEST_CASE(
    "a slider that sticks and slips by turns has the stroke and the period that it has under Verlet, and closes its balance",
    "[contact][friction]") {
    for (const double relaxation_time : {std::numeric_limits<double>::infinity(), 0.3}) {
        Slider slider;
        slider.law.relaxation_time = relaxation_time;
        const auto nothing = [](double, double) {};
        const Stroke found = by_memm(slider, 2e-3, nothing), expected = by_verlet(slider, 2e-3, nothing);
        CHECK(found.furthest - found.nearest > 0.2);
        CHECK(found.furthest - found.nearest == Approx(expected.furthest - expected.nearest).epsilon(1e-3));
        CHECK(found.period == Approx(expected.period).epsilon(1e-3));
        CHECK(found.balance < 1e-12);
    }
}
