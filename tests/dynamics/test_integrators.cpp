// The laws that every integrator obeys, each with the properties that its page (docs/integrators.md) claims for it.
#include <catch2/catch.hpp>

#include "dynamics/schemes.hpp"

using namespace abut;
using namespace abut::test;

TEMPLATE_TEST_CASE("every integrator is of second order on a smooth nonlinear chain", "[dynamics][integrators]",
                   ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    const double time = 4.0;
    const Values exact = reference(chain, held_q, held_p, time, 20000);
    const auto error = [&](int steps) {
        auto integrator = TestType::make(chain, held_q, held_p, time / steps);
        for (int i = 0; i < steps; ++i) integrator.step();
        return distance(integrator.q(), exact);
    };
    CHECK(rate(error, 200) == Approx(2.0).margin(0.1));
    CHECK(rate(error, 400) == Approx(2.0).margin(0.1));
}

TEMPLATE_TEST_CASE("every integrator is of second order on a geometrically exact string", "[dynamics][integrators]",
                   ABUT_ALL_INTEGRATORS) {
    ElasticString string = string_of(5);
    const Values q{0.0, 0.3, 0.1, 0.4, 0.0, 0.2, -0.1, 0.1}, p(8, 0.0);
    const double time = 4.0;
    const Values exact = reference(string, q, p, time, 20000);
    const auto error = [&](int steps) {
        auto integrator = TestType::make(string, q, p, time / steps);
        for (int i = 0; i < steps; ++i) integrator.step();
        return distance(integrator.q(), exact);
    };
    CHECK(rate(error, 200) == Approx(2.0).margin(0.1));
    CHECK(rate(error, 400) == Approx(2.0).margin(0.1));
}

TEMPLATE_TEST_CASE("every integrator keeps its own energy to round-off on nonlinear forces, or is known not to",
                   "[dynamics][integrators]", ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    auto integrator = TestType::make(chain, held_q, held_p, 0.05);
    const double start = integrator.pseudo_energy(), size = integrator.energy();
    double drift = 0.0;
    for (int i = 0; i < 20000; ++i) {
        integrator.step();
        raise(drift, std::abs(integrator.pseudo_energy() - start) / size);
    }
    if (TestType::conserves_nonlinear)
        CHECK(drift < 1e-12);
    else
        CHECK((drift > 1e-6 && drift < 1e-2));
}

TEMPLATE_TEST_CASE("every integrator keeps its own energy to round-off on linear forces", "[dynamics][integrators]",
                   ABUT_ALL_INTEGRATORS) {
    Chain chain({1.0, 0.5, 0.7}, {{-1, 0, {2.0}}, {0, 1, {3.0}}, {1, 2, {1.0}}, {2, -1, {0.5}}});
    auto integrator = TestType::make(chain, {0.3, -0.2, 0.1}, {0.1, 0.2, 0.5}, 0.1);
    const double start = integrator.pseudo_energy();
    double drift = 0.0;
    for (int i = 0; i < 20000; ++i) {
        integrator.step();
        raise(drift, std::abs(integrator.pseudo_energy() - start) / integrator.energy());
    }
    CHECK(drift < 1e-12);
}

TEMPLATE_TEST_CASE("over a million steps the schemes with an energy of their own keep it within 1e-11",
                   "[dynamics][integrators]", MemmExact, MemmGauss2, BilbaoScheme, AsyncScheme) {
    Chain chain = held_chain();
    auto integrator = TestType::make(chain, held_q, held_p, 0.05);
    const double start = integrator.pseudo_energy(), size = integrator.energy();
    double drift = 0.0, error = 0.0;
    for (int i = 0; i < 1'000'000; ++i) {
        integrator.step();
        if (i % 100 != 99) continue;
        raise(drift, std::abs(integrator.pseudo_energy() - start) / size);
        raise(error, std::abs(integrator.energy() - size) / size);
    }
    CHECK(drift < 1e-11);
    CHECK(error < 0.05);  // the true one
}

TEMPLATE_TEST_CASE("the true energy of every integrator stays near its start", "[dynamics][integrators]",
                   ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    const auto error = [&](int steps) {
        auto integrator = TestType::make(chain, held_q, held_p, 20.0 / steps);
        const double start = integrator.energy();
        double worst = 0.0;
        for (int i = 0; i < steps; ++i) {
            integrator.step();
            raise(worst, std::abs(integrator.energy() - start));
        }
        return worst / start;
    };
    CHECK(error(400) < 0.02);
    CHECK((error(800) < 1e-12 || error(400) / error(800) == Approx(energy_ratio<TestType>).epsilon(0.3)));
}

TEMPLATE_TEST_CASE("every integrator keeps linear momentum to round-off", "[dynamics][integrators]", ABUT_ALL_INTEGRATORS) {
    Chain chain = free_chain();
    const Values p{0.5, 0.4, 0.1, 0.3, 0.6, 0.2};
    auto integrator = TestType::make(chain, held_q, p, 0.1);
    double drift = 0.0;
    for (int i = 0; i < 5000; ++i) {
        integrator.step();
        raise(drift, std::abs(total(integrator.p_before(), integrator.p_after()) - 2.1));
    }
    CHECK(drift < 1e-12);
}

TEMPLATE_TEST_CASE("every integrator goes back along the path that it took", "[dynamics][integrators]",
                   ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    auto integrator = TestType::make(chain, held_q, held_p, 0.1);
    for (int i = 0; i < 50; ++i) integrator.step();
    CHECK(distance(integrator.q(), held_q) > 0.1);
    integrator.reverse();
    for (int i = 0; i < 50; ++i) integrator.step();
    CHECK(distance(integrator.q(), held_q) < 1e-12);
}

TEMPLATE_TEST_CASE("every integrator is stable at 0.99 of its limit and explodes at 1.01, or has none",
                   "[dynamics][integrators]", ABUT_ALL_INTEGRATORS) {
    Chain oscillator({1.0}, {{-1, 0, {.stiffness = 4.0}}});  // omega = 2
    const auto growth = [&](double dt) {
        auto integrator = TestType::make(oscillator, {1.0}, {0.0}, dt);
        double largest = 0.0;  // speed: what the energy of a scheme without a limit bounds
        for (int i = 0; i < 1000; ++i) {
            integrator.step();
            raise(largest, std::abs(integrator.p_after()[0]));
        }
        return largest;
    };
    if (std::isfinite(TestType::stability)) {
        CHECK(growth(0.99 * TestType::stability / 2.0) < 20.0);
        CHECK_FALSE(growth(1.01 * TestType::stability / 2.0) <= 1e6);  // it may overflow
    } else {
        CHECK(growth(1.01) < 10.0);
        CHECK(growth(20.0) < 1e3);  // the start with a step far too long gives it speed; it grows no more
    }
}

TEST_CASE("the hidden error of Bilbao is zero at the start, and of second order later", "[dynamics][integrators]") {
    Chain chain = held_chain();
    const auto defect_at = [&](double time, int steps) {
        dynamics::Bilbao bilbao(chain, held_q, held_p, time / steps, 1.0);
        CHECK(bilbao.gauge_defect() == 0.0);
        for (int i = 0; i < steps; ++i) bilbao.step();
        return std::abs(bilbao.gauge_defect());
    };
    CHECK(defect_at(4.0, 400) > 0.0);
    CHECK(defect_at(4.0, 400) / defect_at(4.0, 800) == Approx(4.0).epsilon(0.1));
}

TEST_CASE("slow and fast: half the springs 100 times stiffer, local steps of any ratio keep energy and order",
          "[dynamics][integrators][async]") {
    const std::int32_t ratio = GENERATE(2, 4, 5, 10);
    CAPTURE(ratio);
    const int n = 12;
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = -1; i < n; ++i)
        bonds.push_back({i, i == n - 1 ? -1 : i + 1, {.stiffness = i < n / 2 ? 1.0 : 100.0, .quartic = 0.5}});
    Chain chain(Values(n, 1.0), bonds);
    Values q(n), p(n, 0.0);
    for (int i = 0; i < n; ++i) q[i] = 0.2 * std::sin(0.7 * (i + 1));
    std::vector<std::int32_t> level(n, 0);
    for (int i = n / 2; i < n; ++i) level[i] = 1;
    const auto make = [&](double dt) { return dynamics::MemmAsync(chain, q, p, dt, {{1, ratio}, level}); };
    const double dt = 0.05 * ratio;  // the fast half: omega dt = 20 x 0.05 = 1; the slow one 2 x 0.5 = 1 at most
    auto run = make(dt);
    const double start = run.pseudo_energy(), size = run.energy();
    double drift = 0.0, error = 0.0;
    for (int i = 0; i < 20000; ++i) {
        run.step();
        raise(drift, std::abs(run.pseudo_energy() - start) / size);
        raise(error, std::abs(run.energy() - size) / size);
    }
    CHECK(drift < 1e-12);
    CHECK(error < 0.05);
    const Values exact = reference(chain, q, p, 2.0, 40000);
    const auto distance_at = [&](int steps) {
        auto integrator = make(2.0 / steps);
        for (int i = 0; i < steps; ++i) integrator.step();
        return distance(integrator.q(), exact);
    };
    CHECK(rate(distance_at, 40 * 10 / ratio) == Approx(2.0).margin(0.2));
}
