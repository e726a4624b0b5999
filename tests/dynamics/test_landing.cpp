// Steps that end at events: a ball that bounces, whose force has a kink, and events of which several lie in one step.
#include <catch2/catch.hpp>

#include "abut/base/error.hpp"
#include "abut/dynamics/landing.hpp"
#include "dynamics/own_systems.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using dynamics::Composed;
using dynamics::Composition;
using dynamics::Events;
using dynamics::Landing;
using dynamics::StepChange;

namespace {

constexpr double end = 12.0;
constexpr int n_heights = 40;

double height_of(std::span<const double> q) { return q[0]; }

struct Bounced {
    double error;
    std::size_t events;
};

Bounced bounced(double height, Composition composition, double dt, bool lands) {
    auto motion = bounce_motion(height, end);
    Composed integrator(motion.system, motion.run.q, motion.run.p, dt, composition);
    Landing landing(integrator, Events({height_of}, motion.run.q));
    std::size_t events = 0;
    while (integrator.time() < end - 1e-12) {
        integrator.set_step(std::min(dt, end - integrator.time()), StepChange::keep);
        if (lands)
            events += landing.step().events;
        else
            integrator.step();
        integrator.project();
    }
    return {error_of(motion, integrator), events};
}

/// Root mean square over heights of 1 + 0.013 j.
double error(Composition composition, double dt, bool lands) {
    double sum = 0.0;
    for (int j = 0; j < n_heights; ++j) sum += std::pow(bounced(1.0 + 0.013 * j, composition, dt, lands).error, 2);
    return std::sqrt(sum / n_heights);
}

/// A free particle from 0 with speed 1.
struct Flight {
    Chain system{Values{1.0}, {}};
    Composed<Chain> integrator{system, {0.0}, std::vector{1.0}, 1.0, Composition::blanes_moan_4};
};

}  // namespace

TEST_CASE("a ball that bounces is followed with order 4 where steps land at its contacts, and with less elsewhere",
          "[dynamics][landing]") {
    constexpr Composition composition = Composition::blanes_moan_4;
    const double coarsest = 0.02 * 6.0;
    double last = error(composition, coarsest, true);
    const double plain = error(composition, coarsest, false);
    CHECK(last < 0.2 * plain);
    for (int k = 1; k <= 4; ++k) {
        const double next = error(composition, coarsest / std::pow(2.0, k), true);
        CHECK(std::log2(last / next) >= 3.8);
        CHECK(std::log2(last / next) <= 4.1);
        last = next;
    }
    CHECK(std::log2(plain / error(composition, coarsest / 32.0, false)) / 5.0 < 3.8);
}

TEST_CASE("a composition of order 6 keeps that order through contacts on which its steps land", "[dynamics][landing]") {
    const double coarse = error(Composition::blanes_moan_6, 0.05, true),
                 fine = error(Composition::blanes_moan_6, 0.025, true);
    CHECK(std::log2(coarse / fine) == Approx(6.0).margin(0.3));
}

TEST_CASE("each contact is found once when it closes and once when it opens, since the side is kept",
          "[dynamics][landing]") {
    const double height = 1.0, omega = 20.0, speed = std::sqrt(2.0 * height);
    const double contact = 2.0 * (std::numbers::pi - std::atan(speed * omega)) / omega, period = 2.0 * speed + contact;
    std::size_t expected = 0;
    for (double close = speed; close < end; close += period) expected += close + contact < end ? 2 : 1;
    for (const double dt : {0.1, 0.03, 0.007})
        CHECK(bounced(height, Composition::blanes_moan_4, dt, true).events == expected);
}

TEST_CASE("of several events in a step the first ends it, and the next step goes on with the old length",
          "[dynamics][landing]") {
    Flight flight;
    const auto at = [](double place) { return [=](std::span<const double> q) { return q[0] - place; }; };
    Landing landing(flight.integrator, Events({at(0.7), at(0.2), at(0.2)}, std::vector{0.0}));
    const auto first_step = landing.step();
    CHECK(first_step.events == 2);
    CHECK(first_step.dt == Approx(0.2).epsilon(1e-14));
    CHECK(flight.integrator.time() == Approx(0.2).epsilon(1e-14));
    CHECK(flight.integrator.dt() == 1.0);
    CHECK(std::ranges::equal(landing.events().sides(), std::vector{-1, 1, 1}));
    CHECK(landing.step().dt == Approx(0.5).epsilon(1e-13));
    const auto last = landing.step();
    CHECK(last.events == 0);
    CHECK(last.dt == 1.0);
    CHECK(flight.integrator.q()[0] == Approx(1.7).epsilon(1e-14));
    CHECK(flight.integrator.steps() == 3);
}

TEST_CASE("only the function that has crossed turns, whatever the scales of others", "[dynamics][landing]") {
    for (const double scale : {1.0, 1e9, 1e-9}) {
        Flight flight;
        const auto large = [=](std::span<const double> q) { return scale * (q[0] - 0.3); };
        const auto small = [](std::span<const double> q) { return q[0] - 0.3 - 1e-6; };
        const auto steady = [](std::span<const double> q) { return 1e-7 + 1e-8 * q[0]; };
        Landing landing(flight.integrator, Events({large, small, steady}, std::vector{0.0}));
        const auto first_step = landing.step();
        CHECK(first_step.events == 1);
        CHECK(first_step.dt == Approx(0.3).epsilon(1e-13));
        CHECK(std::ranges::equal(landing.events().sides(), std::vector{1, -1, 1}));
        const auto next = landing.step();
        CHECK(next.events == 1);
        CHECK(next.dt == Approx(1e-6).epsilon(1e-8));
        CHECK(std::ranges::equal(landing.events().sides(), std::vector{1, 1, 1}));
        CHECK(landing.step().events == 0);
    }
}

TEST_CASE("a function that is 0 or infinite at an end of a step does not hide an event of another", "[dynamics][landing]") {
    Flight flight;
    const auto far = [](std::span<const double> q) { return q[0] < 0.5 ? std::numeric_limits<double>::infinity() : 1.0; };
    const auto zero = [](std::span<const double>) { return 0.0; };
    const auto at = [](std::span<const double> q) { return q[0] - 0.25; };
    Landing landing(flight.integrator, Events({far, at}, std::vector{0.0}));
    CHECK(landing.step().dt == Approx(0.25).epsilon(1e-14));
    CHECK(std::ranges::equal(landing.events().sides(), std::vector{1, 1}));
    Flight other;
    Landing beside_zero(other.integrator, Events({zero, at}, std::vector{1, -1}));
    CHECK(beside_zero.step().dt == Approx(0.25).epsilon(1e-14));
}

TEST_CASE("events refuse a start on neither side, sides that are none, and a function that is not a number",
          "[dynamics][landing][errors]") {
    const Values zero{0.0};
    CHECK_THROWS_WITH(Events({height_of}, zero), Contains("function 0 is 0") && Contains("Give the side"));
    CHECK_THROWS_AS(Events({height_of}, Values{std::nan("")}), BadInput);
    CHECK_THROWS_WITH(Events({height_of}, std::vector{0}), Contains("one of them 0"));
    CHECK_THROWS_AS(Events({height_of}, std::vector{1, -1}), BadInput);
    Flight flight;
    const auto root = [](std::span<const double> q) { return std::sqrt(0.5 - q[0]); };
    Landing landing(flight.integrator, Events({root}, zero));
    CHECK_THROWS_AS(landing.step(), Diverged);
    CHECK(flight.integrator.time() == 0.0);
    CHECK(flight.integrator.q()[0] == 0.0);
    CHECK(flight.integrator.dt() == 1.0);
}
