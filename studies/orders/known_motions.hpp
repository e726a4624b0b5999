#pragma once
// Small systems whose motion is known: Duffing's oscillator, a planet of Kepler, the chain of Fermi, Pasta and Ulam, a ball
// that bounces. The study `orders` and the tests of schemes compare with them.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "abut/dynamics/particles.hpp"

namespace abut::studies::orders {

/// Start of a run, and the state at its end.
struct Run {
    std::vector<double> q, p;
    std::vector<double> end_q, end_p;

    /// Square of the Euclidean distance of q and p = (before + after)/2 from the end.
    [[nodiscard]] double squared_error(std::span<const double> at_q, std::span<const double> before,
                                       std::span<const double> after) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < at_q.size(); ++i) {
            const double dq = at_q[i] - end_q[i], dp = 0.5 * (before[i] + after[i]) - end_p[i];
            sum += dq * dq + dp * dp;
        }
        return sum;
    }
    template <class Integrator>
    [[nodiscard]] double squared_error(const Integrator& integrator) const {
        return squared_error(integrator.q(), integrator.p_before(), integrator.p_after());
    }
};

template <class Law>
struct KnownMotion {
    dynamics::Particles<Law> system;
    Run run;
    double time;  ///< at the end [s]
};

/// State after `time` by so many steps of Runge and Kutta's rule of order 4, as the end of the run.
template <dynamics::System S>
Run run_by_small_steps(S& system, const std::vector<double>& q, const std::vector<double>& p, double time, int steps) {
    const std::size_t n = q.size();
    const double h = time / steps;
    const std::span<const double> inverse_mass = system.inverse_mass();
    constexpr std::array weight{1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0}, next{0.5, 0.5, 1.0, 0.0};
    Run run{q, p, q, p};
    std::vector<double> at_q, at_p, sum_q, sum_p, force(n);
    for (int i = 0; i < steps; ++i) {
        at_q = sum_q = run.end_q;
        at_p = sum_p = run.end_p;
        for (std::size_t stage = 0; stage < weight.size(); ++stage) {
            system.force(at_q, force);
            for (std::size_t j = 0; j < n; ++j) {
                const double velocity = inverse_mass[j] * at_p[j];
                sum_q[j] += h * weight[stage] * velocity;
                sum_p[j] += h * weight[stage] * force[j];
                at_q[j] = run.end_q[j] + next[stage] * h * velocity;
                at_p[j] = run.end_p[j] + next[stage] * h * force[j];
            }
        }
        run.end_q = sum_q;
        run.end_p = sum_p;
    }
    return run;
}

/// V = q^2/2 + q^4/4 with unit mass, from 1.5 at rest to t = 20.
inline KnownMotion<dynamics::LineSpring> duffing_motion() {
    constexpr double time = 20.0;
    constexpr std::int32_t fixed = dynamics::Bond<dynamics::LineSpring>::fixed;
    dynamics::Particles<dynamics::LineSpring> system({1.0}, {{fixed, 0, {.stiffness = 1.0, .quartic = 1.0}}});
    const Run run = run_by_small_steps(system, {1.5}, {0.0}, time, 200000);
    return {system, run, time};
}

/// n masses with fixed ends in a row.
inline dynamics::Particles<dynamics::LineSpring> row_of(std::int32_t n, const dynamics::LineSpring& spring) {
    using Bond = dynamics::Bond<dynamics::LineSpring>;
    std::vector<Bond> bonds;
    for (std::int32_t i = Bond::fixed; i < n; ++i) bonds.push_back({i, i == n - 1 ? Bond::fixed : i + 1, spring});
    return {std::vector<double>(static_cast<std::size_t>(n), 1.0), bonds};
}

/// The chain of Fermi, Pasta and Ulam: 16 unit masses with fixed ends, springs of force r + r^2/4 + r^3, from half a sine of
/// 1.5 at rest to t = 40.
inline KnownMotion<dynamics::LineSpring> chain_motion() {
    constexpr std::int32_t n = 16;
    constexpr double time = 40.0;
    auto system = row_of(n, {.stiffness = 1.0, .cubic = 0.25, .quartic = 1.0});
    std::vector<double> q;
    for (std::int32_t i = 1; i <= n; ++i) q.push_back(1.5 * std::sin(std::numbers::pi * i / (n + 1)));
    const Run run = run_by_small_steps(system, q, std::vector<double>(q.size(), 0.0), time, 160000);
    return {system, run, time};
}

/// E of Kepler's equation E - e sin E = t.
inline double eccentric_anomaly(double t, double e) {
    double anomaly = t;
    for (int i = 0; i < 100; ++i) anomaly -= (anomaly - e * std::sin(anomaly) - t) / (1.0 - e * std::cos(anomaly));
    return anomaly;
}

/// A planet on the ellipse of half-axis 1 and eccentricity 0.5 about the origin, from its pericentre on. `Law` has V =
/// -1/|q|.
template <class Law = dynamics::Attraction>
KnownMotion<Law> kepler_motion(double time = 20.0) {
    constexpr double e = 0.5;
    const double width = std::sqrt(1.0 - e * e), anomaly = eccentric_anomaly(time, e);
    const double c = std::cos(anomaly), s = std::sin(anomaly), rate = 1.0 / (1.0 - e * c), start_rate = 1.0 / (1.0 - e);
    return {{{1.0, 1.0}, {{dynamics::Bond<Law>::fixed, 0, {}}}},
            {{1.0 - e, 0.0}, {0.0, width * start_rate}, {c - e, width * s}, {-s * rate, width * c * rate}},
            time};
}

/// A unit mass under gravity 1 on a wall of stiffness 400, dropped from `height` at rest.
inline KnownMotion<dynamics::LineSpring> bounce_motion(double height, double time) {
    constexpr double omega = 20.0, sag = 1.0 / (omega * omega);
    // Parabolas in flight; in contact q = -sag - A cos(omega (t - t_m)) about the middle t_m of it, at both of whose ends
    // q = 0 and |v| is that of the fall.
    const double fall = std::sqrt(2.0 * height), speed = fall, amplitude = std::hypot(sag, speed / omega);
    const double half_contact = (std::numbers::pi - std::atan(speed / omega / sag)) / omega;
    const double t = std::remainder(time, 2.0 * (fall + half_contact));  // about the start, a top of the path
    const double after = std::abs(t) - fall, phase = omega * (after - half_contact);
    Run run{{height}, {0.0}, {height - 0.5 * t * t}, {-t}};
    if (after >= 0.0) {
        run.end_q = {-sag - amplitude * std::cos(phase)};
        run.end_p = {std::copysign(amplitude * omega, t) * std::sin(phase)};
    }
    const dynamics::LineSpring wall{.stiffness = omega * omega, .one_sided = true};
    return {{{1.0}, {{dynamics::Bond<dynamics::LineSpring>::fixed, 0, wall}}, {-1.0}}, run, time};
}

}  // namespace abut::studies::orders
