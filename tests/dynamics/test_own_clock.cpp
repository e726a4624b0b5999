// Times that a program outside dictates to a system of one's own, here Duffing's: V = q^2/2 + q^4/4.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/own_clock.hpp"

using namespace abut;
using Catch::Contains;

namespace {

struct Duffing {
    std::vector<double> inverse_masses{1.0};
    double load = 0.0;  // constant within a step
    std::size_t size() const { return 1; }
    std::span<const double> inverse_mass() const { return inverse_masses; }
    double potential(std::span<const double> q) const {
        const double square = q[0] * q[0];
        return 0.5 * square + 0.25 * square * square - load * q[0];
    }
    void force(std::span<const double> q, std::span<double> f) const { f[0] = load - q[0] - q[0] * q[0] * q[0]; }
    /// Simpson's rule is exact for a force of degree 3.
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double, std::span<double> f) const {
        const auto at = [&](double q) { return load - q - q * q * q; };
        f[0] = (at(q_0[0]) + 4.0 * at(0.5 * (q_0[0] + q_1[0])) + at(q_1[0])) / 6.0;
    }
};

/// q and p after `end`, by Runge and Kutta's rule of order 4 with small steps; load(t) acts.
template <class Load>
std::array<double, 2> exact(double q, double p, double end, const Load& load) {
    constexpr int n = 200000;
    const double h = end / n;
    for (int i = 0; i < n; ++i) {
        const double t = i * h;
        const auto force = [&](double x, double at) { return load(at) - x - x * x * x; };
        const double k1 = p, l1 = force(q, t), k2 = p + 0.5 * h * l1, l2 = force(q + 0.5 * h * k1, t + 0.5 * h);
        const double k3 = p + 0.5 * h * l2, l3 = force(q + 0.5 * h * k2, t + 0.5 * h), k4 = p + h * l3,
                     l4 = force(q + h * k3, t + h);
        q += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        p += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
    }
    return {q, p};
}

double no_load(double) { return 0.0; }

}  // namespace

TEST_CASE("times at random leave the nodes their bits and their error of order 2, as known for Duffing's oscillator",
          "[dynamics][clock]") {
    constexpr double end = 20.0;
    const auto [q_exact, p_exact] = exact(1.5, 0.0, end, no_load);
    // Known errors, found by other programs.
    for (const auto& [tau, known] : {std::array{0.1, 0.040}, std::array{0.05, 0.0098}, std::array{0.025, 0.0025}}) {
        Duffing stepped_system, system;
        dynamics::Memm stepped(stepped_system, {1.5}, std::vector{0.0}, tau), memm(system, {1.5}, std::vector{0.0}, tau);
        dynamics::OwnClock clock(memm);
        std::mt19937 random(3);
        double pieces = 0.0;
        while (memm.time() < end - 1e-9) {
            const double d = tau * (0.2 + 1.6 * static_cast<double>(random()) / std::mt19937::max());
            clock.advance(
                d, [&](double s) { pieces += s; }, [] {});
            while (stepped.steps() < memm.steps()) stepped.step();
            REQUIRE(stepped.q()[0] == memm.q()[0]);
            REQUIRE(stepped.p_after()[0] == memm.p_after()[0]);
        }
        CHECK(pieces == Approx(clock.time()).epsilon(1e-12));
        const double p = 0.5 * (memm.p_before()[0] + memm.p_after()[0]);
        CHECK(std::hypot(memm.q()[0] - q_exact, p - p_exact) == Approx(known).epsilon(0.1));
    }
}

TEST_CASE("between its nodes the path is straight, and off by an eighth of tau^2 times the acceleration",
          "[dynamics][clock]") {
    constexpr double tau = 0.05;
    Duffing system;
    dynamics::Memm memm(system, {1.5}, std::vector{0.0}, tau);
    dynamics::OwnClock clock(memm);
    for (const double t : {0.01, 0.03, 0.05, 0.07, 0.2, 0.31}) {
        clock.advance(
            t - clock.time(), [](double) {}, [] {});
        CHECK(clock.time() == Approx(t).epsilon(1e-12));
        const double error = std::abs(clock.q()[0] - exact(1.5, 0.0, t, no_load)[0]);
        CHECK(error < 1.2 * tau * tau / 8.0 * (1.5 + std::pow(1.5, 3)));
    }
}

TEST_CASE("a load that varies within steps acts by its impulse, with order 2", "[dynamics][clock]") {
    constexpr double end = 4.0;
    const auto load = [](double t) { return std::sin(3.0 * t); };
    const auto [q_exact, p_exact] = exact(0.5, 0.0, end, load);
    const auto error = [&](double tau) {
        Duffing system;
        dynamics::Memm memm(system, {0.5}, std::vector{0.0}, tau);
        dynamics::OwnClock clock(memm);
        double impulse = 0.0, now = 0.0;
        std::mt19937 random(5);
        while (clock.time() < end - 1e-9) {
            const double d = std::min(tau * (0.1 + static_cast<double>(random()) / std::mt19937::max()), end - clock.time());
            now = load(clock.time() + 0.5 * d);
            clock.advance(
                d, [&](double s) { impulse += s * now; },
                [&] {
                    system.load = impulse / tau;
                    impulse = 0.0;
                });
        }
        return std::hypot(memm.q()[0] - q_exact, 0.5 * (memm.p_before()[0] + memm.p_after()[0]) - p_exact);
    };
    CHECK(0.5 * std::log2(error(0.04) / error(0.01)) == Approx(2.0).margin(0.2));
    CHECK(error(0.01) < 1e-3);
}

TEST_CASE("a clock refuses times that are none, and an integrator that went on beside it", "[dynamics][clock]") {
    Duffing system;
    dynamics::Memm memm(system, {1.5}, std::vector{0.0}, 0.1);
    dynamics::OwnClock clock(memm);
    const auto advance = [&](double d) {
        clock.advance(
            d, [](double) {}, [] {});
    };
    for (const double d : {0.0, -0.1, std::nan("")}) CHECK_THROWS_WITH(advance(d), Contains("give a finite time > 0"));
    CHECK(clock.time() == 0.0);
    memm.step();  // at a node it may
    advance(0.05);
    CHECK(clock.time() == Approx(0.15));
    memm.step();
    CHECK_THROWS_AS(advance(0.01), Misuse);
    CHECK_THROWS_WITH(clock.restore(9.0), Contains("Restore both from the same state"));
    CHECK_THROWS_AS(clock.restore(9.0), BadInput);
    clock.restore(memm.time() + 0.02);
    CHECK(clock.since() == Approx(0.02));
}
