#pragma once
// Systems of one's own with solutions that are known: Duffing, Kepler, Fermi, Pasta and Ulam, a ball that bounces.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "dynamics/schemes.hpp"

namespace abut::test {

/// A start, and the state at `time` that is known.
template <class S>
struct Problem {
    S system;
    Values q, p;
    double time;
    State exact;

    [[nodiscard]] double energy() { return system.potential(q) + 0.5 * dynamics::mass_product(p, system.inverse_mass(), p); }
    /// Euclidean distance in q and p = (a + b)/2.
    [[nodiscard]] double error(std::span<const double> q_end, std::span<const double> a, std::span<const double> b) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < q.size(); ++i) {
            const double dq = q_end[i] - exact.q[i], dp = 0.5 * (a[i] + b[i]) - exact.p[i];
            sum += dq * dq + dp * dp;
        }
        return std::sqrt(sum);
    }
    template <class Integrator>
    [[nodiscard]] double error(const Integrator& integrator) const {
        return error(integrator.q(), integrator.p_before(), integrator.p_after());
    }
};

/// V = q^2/2 + q^4/4, from 1.5 at rest to t = 20.
inline Problem<Chain> duffing() {
    Chain system({1.0}, {{-1, 0, {.stiffness = 1.0, .quartic = 1.0}}});
    return {system, {1.5}, {0.0}, 20.0, reference_state(system, {1.5}, {0.0}, 20.0, 200000)};
}

/// 16 masses with fixed ends, the force of a spring r + r^2/4 + r^3, from half a sine of 1.5 at rest to t = 40.
inline Problem<Chain> fermi_pasta_ulam() {
    constexpr std::int32_t n = 16;
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = -1; i < n; ++i)
        bonds.push_back({i, i == n - 1 ? -1 : i + 1, {.stiffness = 1.0, .cubic = 0.25, .quartic = 1.0}});
    Chain system(Values(n, 1.0), bonds);
    Values q(n), p(n, 0.0);
    for (std::int32_t i = 0; i < n; ++i) q[i] = 1.5 * std::sin(std::numbers::pi * (i + 1) / (n + 1));
    return {system, q, p, 40.0, reference_state(system, q, p, 40.0, 160000)};
}

/// The eccentric anomaly of Kepler's equation E - e sin E = t.
inline double eccentric_anomaly(double t, double e) {
    double anomaly = t;
    for (int i = 0; i < 100; ++i) anomaly -= (anomaly - e * std::sin(anomaly) - t) / (1.0 - e * std::cos(anomaly));
    return anomaly;
}
/// On the ellipse of half-axis 1 and eccentricity 0.5 about the origin, t after the pericentre.
inline State on_ellipse(double t) {
    constexpr double e = 0.5;
    const double anomaly = eccentric_anomaly(t, e), c = std::cos(anomaly), s = std::sin(anomaly);
    const double width = std::sqrt(1.0 - e * e), rate = 1.0 / (1.0 - e * c);
    return {{c - e, width * s}, {-s * rate, width * c * rate}};
}
/// A planet from its pericentre to t = 20, `Law` with V = -1/|r|.
template <class Law = dynamics::Attraction>
Problem<dynamics::Particles<Law>> kepler(double time = 20.0) {
    const State start = on_ellipse(0.0);
    return {{{1.0, 1.0}, {{-1, 0, {}}}}, start.q, start.p, time, on_ellipse(time)};
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

/// A ball of mass 1 under gravity 1 on a wall of stiffness 400, dropped from `height` at rest.
inline Problem<Chain> bounce(double height, double time) {
    constexpr double omega = 20.0;
    Chain system({1.0}, {{-1, 0, {.stiffness = omega * omega, .one_sided = true}}}, {-1.0});
    // In contact q = -1/k + A cos(omega (t - t_m)) about the middle t_m of it, at both of whose ends q = 0 and |v| is that
    // of the fall.
    const double speed = std::sqrt(2.0 * height), fall = speed, sag = 1.0 / (omega * omega);
    const double half_contact = (std::numbers::pi - std::atan(speed / omega / sag)) / omega;
    const double amplitude = std::hypot(sag, speed / omega), period = 2.0 * (fall + half_contact);
    const double t = std::remainder(time, period);  // about the start, a top of the path
    const double after = std::abs(t) - fall, sign = t < 0.0 ? -1.0 : 1.0;
    const State exact = after < 0.0 ? State{{height - 0.5 * t * t}, {-t}}
                                    : State{{-sag - amplitude * std::cos(omega * (after - half_contact))},
                                            {sign * amplitude * omega * std::sin(omega * (after - half_contact))}};
    return {system, {height}, {0.0}, time, exact};
}

}  // namespace abut::test
