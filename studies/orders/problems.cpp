#include "studies/orders/problems.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace abut::studies::orders {
namespace {

using Springs = dynamics::Particles<dynamics::LineSpring>;
using dynamics::Bond;
using dynamics::LineSpring;
using std::numbers::pi;

/// q and p as one array, all masses 1: Runge and Kutta's rule of order 4.
std::vector<double> led(Springs& system, std::vector<double> state, double time, int steps) {
    const std::size_t n = system.size();
    const double h = time / steps;
    std::vector<double> at(2 * n), sum(2 * n), slope(2 * n);
    for (int i = 0; i < steps; ++i) {
        at = sum = state;
        constexpr std::array weight{1.0, 2.0, 2.0, 1.0}, next{0.5, 0.5, 1.0, 0.0};
        for (std::size_t k = 0; k < 4; ++k) {
            system.force(std::span(at).first(n), std::span(slope).subspan(n));
            std::copy(at.begin() + static_cast<std::ptrdiff_t>(n), at.end(), slope.begin());
            dynamics::add_scaled(sum, h / 6.0 * weight[k], slope, sum);
            dynamics::add_scaled(state, next[k] * h, slope, at);
        }
        state = sum;
    }
    return state;
}

/// The end of a run from rest by small steps.
Run run_from_rest(Springs& system, const std::vector<double>& q, double time, int steps) {
    std::vector<double> state = q;
    state.resize(2 * q.size(), 0.0);
    const std::vector<double> end = led(system, state, time, steps);
    const auto middle = end.begin() + static_cast<std::ptrdiff_t>(q.size());
    return {q, std::vector<double>(q.size(), 0.0), {end.begin(), middle}, {middle, end.end()}};
}

/// q and p on the ellipse, t after the pericentre, by Kepler's equation E - e sin E = t.
std::vector<double> on_ellipse(double t) {
    constexpr double e = 0.5;
    double anomaly = t;
    for (int i = 0; i < 100; ++i) anomaly -= (anomaly - e * std::sin(anomaly) - t) / (1.0 - e * std::cos(anomaly));
    const double c = std::cos(anomaly), s = std::sin(anomaly), width = std::sqrt(1.0 - e * e), rate = 1.0 / (1.0 - e * c);
    return {c - e, width * s, -s * rate, width * c * rate};
}

constexpr double wall_frequency = 20.0;  // [1/s]

/// Parabolas in flight; in contact q = -s - A cos(omega (t - t_m)) about the middle t_m of it, s the sag at rest.
Run dropped(double height, double time) {
    constexpr double omega = wall_frequency, sag = 1.0 / (omega * omega);
    const double fall = std::sqrt(2.0 * height), speed = fall, amplitude = std::hypot(sag, speed / omega);
    const double half_contact = (pi - std::atan(speed / omega / sag)) / omega;
    const double t = std::remainder(time, 2.0 * (fall + half_contact)), after = std::abs(t) - fall;
    if (after < 0.0) return {{height}, {0.0}, {height - 0.5 * t * t}, {-t}};
    const double phase = omega * (after - half_contact);
    return {{height}, {0.0}, {-sag - amplitude * std::cos(phase)}, {std::copysign(amplitude * omega, t) * std::sin(phase)}};
}

}  // namespace

Problem<LineSpring> duffing() {
    Springs system({1.0}, {{Bond<LineSpring>::fixed, 0, {.stiffness = 1.0, .quartic = 1.0}}});
    const Run run = run_from_rest(system, {1.5}, 20.0, 200000);
    return {system, {run}, 20.0, 1.0, 1, 400, true};
}

Problem<dynamics::Attraction> kepler() {
    constexpr double time = 20.0;
    const auto start = on_ellipse(0.0), end = on_ellipse(time);
    dynamics::Particles<dynamics::Attraction> system({1.0, 1.0}, {{Bond<dynamics::Attraction>::fixed, 0, {}}});
    const Run run{{start[0], start[1]}, {start[2], start[3]}, {end[0], end[1]}, {end[2], end[3]}};
    return {system, {run}, time, 3.0, 1, 400, true};
}

Problem<LineSpring> chain() {
    constexpr std::int32_t n = 16, fixed = Bond<LineSpring>::fixed;
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = fixed; i < n; ++i)
        bonds.push_back({i, i == n - 1 ? fixed : i + 1, {.stiffness = 1.0, .cubic = 0.25, .quartic = 1.0}});
    Springs system(std::vector<double>(n, 1.0), bonds);
    std::vector<double> q(n);
    for (std::int32_t i = 0; i < n; ++i) q[i] = 1.5 * std::sin(pi * (i + 1) / (n + 1));
    const Run run = run_from_rest(system, q, 40.0, 160000);
    return {system, {run}, 40.0, 1.0, n + 1, 400, true};
}

Problem<LineSpring> bounce() {
    constexpr double time = 12.0;
    Springs system({1.0}, {{Bond<LineSpring>::fixed, 0, {.stiffness = wall_frequency * wall_frequency, .one_sided = true}}},
                   {-1.0});
    Problem<LineSpring> problem{system, {}, time, 1.0, 1, 400, false};
    for (int j = 0; j < 40; ++j) problem.runs.push_back(dropped(1.0 + 0.013 * j, time));
    return problem;
}

Problem<LineSpring> bar() {
    constexpr std::int32_t n = 200, fixed = Bond<LineSpring>::fixed;
    constexpr double time = 120.0, centre = 40.0, width = 8.0;  // cells; c = 1
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = fixed; i < n; ++i) bonds.push_back({i, i == n - 1 ? fixed : i + 1, {.stiffness = 1.0}});
    Run run;
    for (std::int32_t i = 0; i < n; ++i)
        for (const double t : {0.0, time}) {
            const double s = (i - centre - t) / width, u = std::exp(-s * s);
            (t == 0.0 ? run.q : run.end_q).push_back(u);
            (t == 0.0 ? run.p : run.end_p).push_back(2.0 * s / width * u);
        }
    return {Springs(std::vector<double>(n, 1.0), bonds), {run}, time, 1.0, n + 1, 150, false};
}

}  // namespace abut::studies::orders
