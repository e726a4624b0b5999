#pragma once
// Systems of one's own whose motion is known, and what compositions of sub-flows do to them by the formulas alone.
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/schemes.hpp"
#include "studies/orders/known_motions.hpp"

namespace abut::test {

using studies::orders::bounce_motion;
using studies::orders::chain_motion;
using studies::orders::duffing_motion;
using studies::orders::kepler_motion;
using studies::orders::KnownMotion;
using studies::orders::row_of;

template <class Law>
double start_energy(const KnownMotion<Law>& motion) {
    const auto& [q, p, end_q, end_p] = motion.run;
    return motion.system.potential(q) + 0.5 * dynamics::mass_product(p, motion.system.inverse_mass(), p);
}
/// Euclidean distance in q and p = (a + b)/2 from the known end.
template <class Law, class Integrator>
double error_of(const KnownMotion<Law>& motion, const Integrator& integrator) {
    return std::sqrt(motion.run.squared_error(integrator));
}

/// Kepler's potential with a discrete gradient along the mean position, which is no integral along the path; `is_exact` is
/// what it says about that.
template <bool is_exact>
struct CentralGradient : dynamics::Attraction {
    static constexpr bool mean_is_exact = is_exact;
    [[nodiscard]] Vector<2> mean_tension(const Vector<2>& r_0, const Vector<2>& r_1) const {
        const double at_0 = r_0.norm(), at_1 = r_1.norm();
        return 1.0 / (at_0 * at_1 * (at_0 + at_1)) * (r_0 + r_1);
    }
};

/// The doubled system of docs/integrators.md, Higher orders, for unit masses, by its formulas alone: the mean of the force
/// along a straight path is Simpson's, exact with one panel where the force is a cubic.
class Doubled {
public:
    using Force = std::function<Values(const Values&)>;
    Doubled(Force force, int panels, Values q, const Values& p)
        : force_(std::move(force)), panels_(panels), q_(std::move(q)), a_(p), b_(p) {}

    /// A(s), or B(s) where not `kicks_a`.
    void flow(bool kicks_a, double s) {
        Values& kicked = kicks_a ? a_ : b_;
        const Values& carrying = kicks_a ? b_ : a_;
        const Values from = q_;
        for (int node = 0; node <= 2 * panels_; ++node) {
            const double share = 0.5 * node / panels_;
            const double weight = node == 0 || node == 2 * panels_ ? 1.0 : node % 2 == 1 ? 4.0 : 2.0;
            for (std::size_t i = 0; i < q_.size(); ++i) q_[i] = from[i] + share * s * carrying[i];
            const Values force = force_(q_);
            for (std::size_t i = 0; i < q_.size(); ++i) kicked[i] += 2.0 * s * weight / (6.0 * panels_) * force[i];
        }
    }
    /// A(d/4) B(d/2) A(d/4)
    void step(double d) {
        flow(true, 0.25 * d);
        flow(false, 0.5 * d);
        flow(true, 0.25 * d);
    }
    /// Largest difference between this state and another.
    [[nodiscard]] double distance(std::span<const double> q, std::span<const double> a, std::span<const double> b) const {
        return std::max({test::distance(q_, q), test::distance(a_, a), test::distance(b_, b)});
    }

private:
    Force force_;
    int panels_;
    Values q_, a_, b_;
};

inline Values force_of_duffing(const Values& q) { return {-q[0] - q[0] * q[0] * q[0]}; }
inline Values force_of_kepler(const Values& q) {
    const double cube = std::pow(q[0] * q[0] + q[1] * q[1], 1.5);
    return {-q[0] / cube, -q[1] / cube};
}
inline Values force_of_chain(const Values& q) {
    Values force(q.size(), 0.0);
    for (std::size_t i = 0; i <= q.size(); ++i) {
        const double r = (i < q.size() ? q[i] : 0.0) - (i > 0 ? q[i - 1] : 0.0), tension = r + 0.25 * r * r + r * r * r;
        if (i > 0) force[i - 1] += tension;
        if (i < q.size()) force[i] -= tension;
    }
    return force;
}

/// The doubled system of an oscillator of frequency 1 is an ordinary splitting of (x, y): q = x y, a = -x^2, b = y^2, where
/// A(s) adds s y to x, and B(s) takes s x from y. This is its matrix, rows of x and y.
class Splitting {
public:
    void flow(bool kicks_a, double s) {
        for (std::size_t column = 0; column < 2; ++column)
            if (kicks_a)
                x_[column] += s * y_[column];
            else
                y_[column] -= s * x_[column];
    }
    void step(double d) {
        flow(true, 0.25 * d);
        flow(false, 0.5 * d);
        flow(true, 0.25 * d);
    }
    [[nodiscard]] double trace() const { return x_[0] + y_[1]; }
    [[nodiscard]] double norm() const { return std::hypot(x_[0], x_[1], std::hypot(y_[0], y_[1])); }
    void divide_by(double size) {
        for (double* entry : {&x_[0], &x_[1], &y_[0], &y_[1]}) *entry /= size;
    }

private:
    std::array<double, 2> x_{1.0, 0.0}, y_{0.0, 1.0};
};

}  // namespace abut::test
