// How every integrator starts, changes its step, and refuses input that it cannot use.
#include <catch2/catch.hpp>

#include "dynamics/schemes.hpp"

using namespace abut;
using namespace abut::test;
using dynamics::StepChange;

TEMPLATE_TEST_CASE("every integrator starts from q and p at one time", "[dynamics][integrators]", ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    const auto error = [&](double dt) {  // of p^0 as it is read back, and of the first step against the Taylor series
        auto integrator = TestType::make(chain, held_q, held_p, dt);
        double worst = 0.0;
        for (std::size_t i = 0; i < held_p.size(); ++i)
            raise(worst, std::abs(0.5 * (integrator.p_before()[i] + integrator.p_after()[i]) - held_p[i]));
        Values f(held_q.size());
        chain.force(held_q, f);
        integrator.step();
        for (std::size_t i = 0; i < f.size(); ++i)
            raise(worst,
                  std::abs(integrator.q()[i] - held_q[i] - dt * chain.inverse_mass()[i] * (held_p[i] + 0.5 * dt * f[i])));
        return worst;
    };
    CHECK(error(1e-3) < 1e-8);  // third order
    CHECK(error(1e-4) < 1e-11);
}

TEST_CASE("a force that is not a number ends a run of Bilbao or energy-momentum with an error",
          "[dynamics][integrators][errors]") {
    const auto nan = std::nan("");
    Chain two({1.0, 1.0}, {{-1, 0, {1.0}}, {1, -1, {1.0}}}, {nan, 0.0});
    const Values q{0.1, 0.1}, p{0.0, 0.0};
    dynamics::EnergyMomentum implicit(two, q, p, 0.1);
    CHECK_THROWS_AS(implicit.step(), Diverged);
    CHECK(implicit.q()[1] == 0.1);
    CHECK_THROWS_AS(dynamics::Bilbao(two, q, p, 0.1, 1.0), Diverged);
    Chain sound({1.0, 1.0}, {{-1, 0, {1.0}}, {1, -1, {1.0}}});
    CHECK_THROWS_AS(dynamics::Bilbao(sound, q, p, 0.1, nan), Diverged);
}

TEST_CASE("the parasitic momentum of a scheme without half steps is zero, seen from its base, too",
          "[dynamics][integrators]") {
    Chain chain = held_chain();
    dynamics::EnergyMomentum scheme(chain, held_q, held_p, 0.1);
    dynamics::Integrator<dynamics::EnergyMomentum<Chain>, Chain>& base = scheme;
    Values e(held_q.size(), 1.0);
    base.parasitic_momentum(e);
    CHECK(distance(e, Values(held_q.size(), 0.0)) == 0.0);
}

TEMPLATE_TEST_CASE("every integrator reports by how much a restart with another step changes its energy",
                   "[dynamics][integrators]", ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    const auto jump_of = [&](double dt) {
        auto integrator = TestType::make(chain, held_q, held_p, dt);
        const double start = integrator.pseudo_energy();
        while (integrator.time() < 0.4 - 0.5 * dt) integrator.step();
        const double before = integrator.pseudo_energy();
        integrator.step(0.5 * dt, StepChange::restart);
        const double drift = std::abs(integrator.pseudo_energy() - integrator.restart_jumps() - before);
        if (TestType::conserves_nonlinear) CHECK(drift < 1e-13 * std::abs(start));
        return std::abs(integrator.restart_jumps());
    };
    const double coarse = jump_of(0.04), fine = jump_of(0.02);
    CAPTURE(coarse, fine);
    if (TestType::one_step)
        CHECK(coarse == 0.0);
    else
        CHECK(coarse / fine == Approx(energy_ratio<TestType>).epsilon(0.25));
}

TEMPLATE_TEST_CASE("kept steps a, b, a, b: two-step schemes solve with the acceleration times 4ab/(a+b)^2, others are right",
                   "[dynamics][integrators]", ABUT_ALL_INTEGRATORS) {
    const double a = 0.0005, b = 0.0015, time = 6.0;
    const auto position = [&](StepChange change) {
        Chain oscillator({1.0}, {{-1, 0, {.stiffness = 1.0}}});
        auto integrator = TestType::make(oscillator, {1.0}, {0.0}, a);
        while (integrator.time() < time - 0.5 * a) {
            integrator.step(a, change);
            integrator.step(b, change);
        }
        return integrator.q()[0];
    };
    const double factor = TestType::two_step ? 4.0 * a * b / ((a + b) * (a + b)) : 1.0;
    CHECK(position(StepChange::keep) == Approx(std::cos(std::sqrt(factor) * time)).margin(3e-3));
    CHECK(position(StepChange::restart) == Approx(std::cos(time)).margin(3e-3));
}

TEMPLATE_TEST_CASE("every integrator refuses steps that are not positive and finite, and states that do not fit",
                   "[dynamics][integrators][errors]", ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    const double nan = std::nan("");
    const auto make = [&](const Values& q, const Values& p, double dt) { return TestType::make(chain, q, p, dt).time(); };
    for (const double dt : {0.0, -0.1, nan, std::numeric_limits<double>::infinity()}) {
        CAPTURE(dt);
        CHECK_THROWS_WITH(make(held_q, held_p, dt),
                          Catch::Matchers::Contains("time step is") && Catch::Matchers::Contains("> 0"));
        auto integrator = TestType::make(chain, held_q, held_p, 0.1);
        CHECK_THROWS_AS(integrator.step(dt, StepChange::keep), BadInput);
        CHECK_THROWS_AS(integrator.step(dt, StepChange::restart), BadInput);
        CHECK(integrator.steps() == 0);
        CHECK(integrator.dt() == 0.1);
    }
    const Values two{0.0, 0.0};
    CHECK_THROWS_AS(make(held_q, two, 0.1), BadInput);
    CHECK_THROWS_AS(make(two, held_p, 0.1), BadInput);
    Values not_finite = held_q;
    not_finite[2] = nan;
    CHECK_THROWS_WITH(make(not_finite, held_p, 0.1), Catch::Matchers::Contains("position 2 is nan"));
    CHECK_THROWS_WITH(make(held_q, not_finite, 0.1), Catch::Matchers::Contains("momentum 2 is nan"));
}

TEMPLATE_TEST_CASE("every integrator goes on with the same bits from a saved state", "[dynamics][integrators][state]",
                   ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain(), other = held_chain();
    auto integrator = TestType::make(chain, held_q, held_p, 0.1);
    for (int i = 0; i < 7; ++i) integrator.step();
    integrator.step(0.07, StepChange::restart);
    const dynamics::IntegratorState state = integrator.state();
    auto restored = TestType::make(other, Values(held_q.size(), 0.01), Values(held_p.size(), 0.02), 0.1);
    restored.restore(state);
    for (int i = 0; i < 5; ++i) {
        integrator.step();
        restored.step();
    }
    CHECK(restored.steps() == 13);
    CHECK(restored.time() == integrator.time());
    CHECK(restored.restart_jumps() == integrator.restart_jumps());
    CHECK(std::ranges::equal(restored.q(), integrator.q()));
    CHECK(std::ranges::equal(restored.p_before(), integrator.p_before()));
    CHECK(std::ranges::equal(restored.p_after(), integrator.p_after()));
    CHECK(restored.pseudo_energy() == integrator.pseudo_energy());
    CHECK_FALSE(std::ranges::equal(integrator.q(), state.q));
}

TEMPLATE_TEST_CASE("a saved state that does not fit is refused, and the integrator stays as it is",
                   "[dynamics][integrators][state][errors]", ABUT_ALL_INTEGRATORS) {
    Chain chain = held_chain();
    auto integrator = TestType::make(chain, held_q, held_p, 0.1);
    integrator.step();
    const dynamics::IntegratorState good = integrator.state();
    std::vector<dynamics::IntegratorState> wrong(6, good);
    wrong[0].q.pop_back();
    wrong[1].p_after.push_back(0.0);
    wrong[2].p_before[1] = std::nan("");
    wrong[3].dt = 0.0;
    wrong[4].of_scheme.push_back(1.0);
    wrong[5].steps = -1;
    for (const dynamics::IntegratorState& state : wrong) CHECK_THROWS_AS(integrator.restore(state), BadInput);
    CHECK(std::ranges::equal(integrator.q(), good.q));
    CHECK(std::ranges::equal(integrator.p_after(), good.p_after));
    CHECK(integrator.steps() == 1);
}
