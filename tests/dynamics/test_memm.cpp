#include <catch2/catch.hpp>

#include <functional>

#include "dynamics/scenes.hpp"

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

/// q(time) from q = 1 at rest, by many small Runge-Kutta steps.
double reference(const Well& well, double time) {
    const int n = 20000;
    const double h = time / n;
    double q = 1.0, v = 0.0;
    for (int i = 0; i < n; ++i) {
        const double k_1 = well.force_at(q), l_1 = v;
        const double k_2 = well.force_at(q + 0.5 * h * l_1), l_2 = v + 0.5 * h * k_1;
        const double k_3 = well.force_at(q + 0.5 * h * l_2), l_3 = v + 0.5 * h * k_2;
        const double k_4 = well.force_at(q + h * l_3), l_4 = v + h * k_3;
        q += h / 6.0 * (l_1 + 2 * l_2 + 2 * l_3 + l_4);
        v += h / 6.0 * (k_1 + 2 * k_2 + 2 * k_3 + k_4);
    }
    return q;
}

/// A Memm from q = 1 at rest.
Memm<Well> from_rest(Well& well, double dt) { return Memm<Well>(well, {1.0}, std::vector<double>{0.0}, dt); }

}  // namespace

TEST_CASE("MEMM is of second order", "[dynamics][memm]") {
    Well well{.k = 1.0, .b = GENERATE(0.0, 2.0)};
    const double time = 5.0;
    const double exact = well.b == 0.0 ? std::cos(time) : reference(well, time);
    std::vector<double> errors;
    for (const int steps : {100, 200, 400}) {
        auto memm = from_rest(well, time / steps);
        for (int i = 0; i < steps; ++i) memm.step();
        errors.push_back(std::abs(memm.q()[0] - exact));
    }
    CHECK(std::log2(errors[0] / errors[1]) == Approx(2.0).margin(0.1));
    CHECK(std::log2(errors[1] / errors[2]) == Approx(2.0).margin(0.1));
}

TEST_CASE("H~ is exact for any sequence of kept steps", "[dynamics][memm]") {
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
          "[dynamics][memm]") {
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

TEST_CASE("H - H~ is a square, zero only without acceleration", "[dynamics][memm]") {
    Well well;
    auto memm = from_rest(well, 0.1);
    CHECK(memm.energy_excess() == Approx(0.125 * std::pow(0.1 * 1.0, 2)).epsilon(1e-12));  // 1/8 |dt F|^2
    Well free{.k = 0.0};
    CHECK(from_rest(free, 0.1).energy_excess() == 0.0);
}

TEST_CASE("the parasitic momentum of a linear system stays at round-off", "[dynamics][memm]") {
    Well well;
    auto memm = from_rest(well, 0.3);
    std::vector<double> e(1);
    for (int i = 0; i < 1000; ++i) {
        memm.step();
        memm.parasitic_momentum(e);
        REQUIRE(std::abs(e[0]) < 1e-12);
    }
}

TEST_CASE(
    "the trap of alternating steps: kept, a, b, a, b solves with the acceleration times 4ab/(a+b)^2; restarted, it is right",
    "[dynamics][memm]") {
    const double a = 0.0005, b = 0.0015, time = 6.0;
    const auto position = [&](StepChange change) {
        Well well;
        auto memm = from_rest(well, a);
        while (memm.time() < time - 0.5 * a) {
            memm.step(a, change);
            memm.step(b, change);
        }
        return memm.q()[0];
    };
    const double factor = 4.0 * a * b / ((a + b) * (a + b));
    CHECK(position(StepChange::keep) == Approx(std::cos(std::sqrt(factor) * time)).margin(3e-3));
    CHECK(std::abs(position(StepChange::keep) - std::cos(time)) > 0.1);
    CHECK(position(StepChange::restart) == Approx(std::cos(time)).margin(3e-3));
}

TEST_CASE("restarts report exactly by how much they change H~, and by O(dt^2)", "[dynamics][memm]") {
    Well well{.k = 1.0, .b = 1.0};
    const auto jump_of = [&](double dt) {
        auto memm = from_rest(well, dt);
        const double start = memm.pseudo_energy();
        for (int i = 0; i < 5; ++i) memm.step();
        memm.step(0.5 * dt, StepChange::restart);
        CHECK(memm.pseudo_energy() - memm.restart_jumps() == Approx(start).epsilon(1e-13));
        return std::abs(memm.restart_jumps());
    };
    const double coarse = jump_of(0.02), fine = jump_of(0.01);
    CHECK(coarse > 0.0);
    CHECK(coarse / fine == Approx(4.0).epsilon(0.2));
}

TEST_CASE("a step that does not change needs no restart", "[dynamics][memm]") {
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
                       "[dynamics][memm]", ((int Dim), Dim), 2, 3) {
    const auto mesh = mesh::box<Dim>({.size = Dim == 2 ? 0.3 : 0.6});
    dynamics::SolidOptions<Dim> options;
    options.materials = {{.young = 2.0, .poisson = 0.3, .density = 1.5}};
    dynamics::Solid<Dim> solid(mesh, options);
    const double omega = highest_frequency(solid);
    for (const double part : {0.98, 1.01}) {
        CAPTURE(part);
        const std::vector<double> at_start = random_state(solid.size(), 6, 1e-3);
        const std::vector<double> rest(solid.size(), 0.0);
        Memm<dynamics::Solid<Dim>> memm(solid, at_start, rest, part * 2.0 / omega);
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

TEST_CASE("a time step that is not positive and finite, or a state of another size, is refused",
          "[dynamics][memm][errors]") {
    Well well;
    const double dt = GENERATE(0.0, -0.1, std::nan(""), std::numeric_limits<double>::infinity());
    const std::vector<double> zero{0.0}, two{0.0, 0.0};
    CHECK_THROWS_AS(from_rest(well, dt), std::invalid_argument);
    CHECK_THROWS_WITH(from_rest(well, dt), Catch::Matchers::Contains("time step is") && Catch::Matchers::Contains("> 0"));
    auto memm = from_rest(well, 0.1);
    CHECK_THROWS_AS(memm.step(dt, StepChange::keep), std::invalid_argument);
    CHECK_THROWS_AS(memm.step(dt, StepChange::restart), std::invalid_argument);
    CHECK(memm.steps() == 0);
    CHECK_THROWS_AS(Memm<Well>(well, two, zero, 0.1), std::invalid_argument);
    CHECK_THROWS_WITH(Memm<Well>(well, zero, two, 0.1), Catch::Matchers::Contains("1 positions and 2 momenta"));
}

TEST_CASE("a kick to one half-step momentum is the parasitic momentum, and alternates in a linear system for ever",
          "[dynamics][memm]") {
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
