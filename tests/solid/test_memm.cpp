#include <catch2/catch.hpp>

#include <functional>

#include "solid/dense_stiffness.hpp"
#include "solid/scenes.hpp"

using namespace abut;
using namespace abut::test;
using dynamics::Memm;
using dynamics::StepChange;

namespace {

/// One mass in a well V(q) = k/2 q^2 + b/4 q^4: the smallest System there is.
struct Well {
    double k = 1.0;
    double b = 0.0;
    std::vector<double> inverse_masses{1.0};

    std::size_t size() const { return 1; }
    std::span<const double> inverse_mass() const { return inverse_masses; }
    double force_at(double q) const { return -k * q - b * q * q * q; }
    void force(std::span<const double> q, std::span<double> f) const { f[0] = force_at(q[0]); }
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double, std::span<double> f) const {
        const double node = 0.5 / std::sqrt(3.0);  // two points are exact for a cubic force
        const auto at = [&](double tau) { return force_at(q_0[0] + tau * (q_1[0] - q_0[0])); };
        f[0] = 0.5 * (at(0.5 - node) + at(0.5 + node));
    }
    double potential(std::span<const double> q) const { return 0.5 * k * q[0] * q[0] + 0.25 * b * std::pow(q[0], 4); }
    double work() const { return 0.0; }
};
static_assert(dynamics::System<Well>);

/// A Memm from q = 1 at rest.
Memm<Well> from_rest(Well& well, double dt) { return Memm<Well>(well, {1.0}, std::vector<double>{0.0}, dt); }

}  // namespace

TEST_CASE("H~ is exact for any sequence of kept steps", "[solid][memm]") {
    Well well{.k = 1.0, .b = 3.0};
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any_step(0.01, 0.2);
    double drift = 0.0, growth = 0.0;  // over the first H of each run
    const auto run = [&](int steps, const auto& step) {
        auto memm = from_rest(well, 0.1);
        const double start = memm.pseudo_energy(), size = start + memm.energy_excess();
        for (int i = 0; i < steps; ++i) {
            memm.step(step(i), StepChange::keep);
            REQUIRE(std::isfinite(memm.pseudo_energy()));
            raise(drift, std::abs(memm.pseudo_energy() - start) / size);
            raise(growth, (memm.pseudo_energy() + memm.energy_excess()) / size);
        }
    };
    SECTION("steps drawn at random, in runs too short to explode") {
        for (int i = 0; i < 500; ++i) run(20, [&](int) { return any_step(random); });
        CHECK(growth < 10.0);
    }
    SECTION("steps that change slowly, from 0.02 to 0.18 and back") {
        run(10000, [](int i) { return 0.1 + 0.08 * std::sin(0.01 * i); });
        CHECK(growth < 1.1);
    }
    CHECK(drift < 1e-13);
}

TEST_CASE("the trap of irregular steps: kept, steps drawn at random explode at any size, and H~ does not notice",
          "[solid][memm]") {
    // In a number of steps that goes as 1/(omega^2 variance of dt).
    Well well;
    const double mean = GENERATE(0.1, 0.03, 0.01);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> step(0.1 * mean, 1.9 * mean);
    const double variance = std::pow(1.8 * mean, 2) / 12.0;
    auto memm = from_rest(well, mean);
    const double start = memm.pseudo_energy();
    double largest = start, drift = 0.0;
    while (memm.steps() < 200.0 / variance && largest < 1e6 * start) {
        memm.step(step(random), StepChange::keep);
        raise(largest, memm.pseudo_energy() + memm.energy_excess());
        raise(drift, std::abs(memm.pseudo_energy() - start) / largest);
    }
    CHECK(largest >= 1e6 * start);
    CHECK(memm.steps() > 1.0 / variance);
    CHECK(drift < 1e-12);
}

TEST_CASE("where a step ends is known before its force, and a step that is set first has the bits of one that is dictated",
          "[solid][memm]") {
    Well well{.k = 1.0, .b = 3.0};
    const auto change = GENERATE(StepChange::keep, StepChange::restart);
    auto dictated = from_rest(well, 0.1), set_first = from_rest(well, 0.1);
    for (int i = 0; i < 50; ++i) {
        const double dt = 0.1 + 0.02 * std::sin(0.3 * i);
        dictated.step(dt, change);
        set_first.set_step(dt, change);
        const double next = set_first.next_q()[0];
        set_first.step();
        CHECK(set_first.q()[0] == next);
        CHECK(set_first.q()[0] == dictated.q()[0]);
        CHECK(set_first.p_after()[0] == dictated.p_after()[0]);
        CHECK(set_first.time() == dictated.time());
    }
    CHECK(set_first.restart_jumps() == dictated.restart_jumps());
    const double before = set_first.dt();
    CHECK_THROWS_AS(set_first.set_step(0.0, change), BadInput);
    CHECK(set_first.dt() == before);
}

TEST_CASE("H - H~ is a square, zero only without acceleration", "[solid][memm]") {
    Well well;
    auto memm = from_rest(well, 0.1);
    CHECK(memm.energy_excess() == Approx(0.125 * std::pow(0.1 * 1.0, 2)).epsilon(1e-12));  // 1/8 |dt F|^2
    Well free{.k = 0.0};
    CHECK(from_rest(free, 0.1).energy_excess() == 0.0);
}

TEST_CASE("the parasitic momentum of a linear system stays at round-off", "[solid][memm]") {
    Well well;
    auto memm = from_rest(well, 0.3);
    std::vector<double> e(1);
    for (int i = 0; i < 1000; ++i) {
        memm.step();
        memm.parasitic_momentum(e);
        REQUIRE(std::abs(e[0]) < 1e-12);
    }
}

TEST_CASE("a step that does not change needs no restart", "[solid][memm]") {
    Well well{.k = 1.0, .b = 1.0};
    auto plain = from_rest(well, 0.1), asked = from_rest(well, 0.1);
    for (int i = 0; i < 20; ++i) {
        plain.step();
        asked.step(0.1, StepChange::restart);
    }
    CHECK(plain.q()[0] == asked.q()[0]);
    CHECK(asked.restart_jumps() == 0.0);
}

TEMPLATE_TEST_CASE_SIG("a free solid explodes at 1.01 times the limit 2/omega and not at 0.98, and H~ does not notice",
                       "[solid][memm]", ((int Dim), Dim), 2, 3) {
    const auto mesh = mesh::box<Dim>({.size = Dim == 2 ? 0.3 : 0.6});
    solid::SolidOptions<Dim> options;
    options.materials = {{.young = 2.0, .poisson = 0.3, .density = 1.5}};
    solid::Solid<Dim> solid(mesh, options);
    const double omega = highest_frequency(solid);
    for (const double part : {0.98, 1.01}) {
        CAPTURE(part);
        const std::vector<double> at_start = random_state(solid.size(), 6, 1e-3);
        const std::vector<double> rest(solid.size(), 0.0);
        Memm<solid::Solid<Dim>> memm(solid, at_start, rest, part * 2.0 / omega);
        const double start = memm.pseudo_energy();
        double size = 0.0, energy = 0.0, drift = 0.0;  // the drift over the largest energy H so far
        for (int i = 0; i < 400; ++i) {
            memm.step();
            raise(size, largest(memm.q()));
            raise(energy, memm.pseudo_energy() + memm.energy_excess());
            raise(drift, std::abs(memm.pseudo_energy() - start) / energy);
        }
        REQUIRE(std::isfinite(size));
        if (part < 1.0)
            CHECK(size < 0.1);
        else
            CHECK(size > 1e6);
        CHECK(drift < 1e-13);
    }
}

TEST_CASE("a kick to one half-step momentum is the parasitic momentum, and alternates in a linear system for ever",
          "[solid][memm]") {
    Well well;
    const double dt = 0.3, kick = 1e-3;
    auto memm = from_rest(well, dt);
    bool kicked = false;
    memm.set_after_step([&](auto, double, auto, auto p_after) {
        if (!kicked) p_after[0] += kick;
        kicked = true;
    });
    std::vector<double> e(1);
    double sign = 1.0;
    for (int i = 0; i < 100; ++i, sign = -sign) {
        memm.step();
        memm.parasitic_momentum(e);
        REQUIRE(e[0] == Approx(sign * kick).epsilon(1e-9));
    }
}
