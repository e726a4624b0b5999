// The laws that every integrator obeys, each with the properties that its page (docs/integrators.md) claims for it.
#include <catch2/catch.hpp>

#include <functional>
#include <random>

#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/energy_momentum.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/memm_async.hpp"
#include "abut/dynamics/particles.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using dynamics::Bond;
using dynamics::LineSpring;
using dynamics::PathMean;
using dynamics::StepChange;
using dynamics::StringSegment;

namespace {

using Chain = dynamics::Particles<LineSpring>;
using ElasticString = dynamics::Particles<StringSegment>;

using Values = std::vector<double>;

// Each way of making an integrator, and what may be asked of it.
template <PathMean mean>
struct MemmOf {
    static constexpr bool one_step = false;
    static constexpr bool two_step = true;
    static constexpr double stability = 2.0;  // omega dt
    static constexpr bool conserves_nonlinear = mean == PathMean::system || mean == PathMean::gauss_2;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::Memm<S>(system, std::move(q), p, dt, mean);
    }
};
struct MemmExact : MemmOf<PathMean::system> {};
struct MemmGauss1 : MemmOf<PathMean::gauss_1> {};
struct MemmGauss2 : MemmOf<PathMean::gauss_2> {};
struct MemmGauss3 : MemmOf<PathMean::gauss_3> {
    static constexpr bool conserves_nonlinear = true;
};
struct LeapfrogScheme {
    static constexpr bool one_step = false;
    static constexpr bool two_step = false;
    static constexpr double stability = 2.0;
    static constexpr bool conserves_nonlinear = false;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::Leapfrog<S>(system, std::move(q), p, dt);
    }
};
struct BilbaoScheme {
    static constexpr bool one_step = false;
    static constexpr bool two_step = false;
    static constexpr double stability = std::numeric_limits<double>::infinity();
    static constexpr bool conserves_nonlinear = true;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::Bilbao<S>(system, std::move(q), p, dt, 1.0);
    }
};
struct EnergyMomentumScheme {
    static constexpr bool one_step = true;
    static constexpr bool two_step = false;
    static constexpr double stability = std::numeric_limits<double>::infinity();
    static constexpr bool conserves_nonlinear = true;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        return dynamics::EnergyMomentum<S>(system, std::move(q), p, dt);
    }
};
/// The first half of the degrees of freedom with the whole step, the rest with a third of it.
struct AsyncScheme {
    static constexpr bool one_step = false;
    static constexpr bool two_step = true;
    static constexpr double stability = 2.0;
    static constexpr bool conserves_nonlinear = true;
    template <class S>
    static auto make(S& system, Values q, const Values& p, double dt) {
        std::vector<std::int32_t> level(q.size(), 0);
        std::fill(level.begin() + static_cast<std::ptrdiff_t>((q.size() + 1) / 2), level.end(), 1);
        return dynamics::MemmAsync<S>(system, std::move(q), p, dt, {{1, 3}, level});
    }
};

/// Six masses between two walls, springs of the fourth order.
Chain held_chain() {
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = -1; i < 6; ++i) bonds.push_back({i, i == 5 ? -1 : i + 1, {.stiffness = 1.0, .quartic = 1.0}});
    return Chain({1.0, 0.5, 1.0, 0.8, 1.0, 2.0}, bonds);
}
const Values held_q{0.3, -0.2, 0.1, 0.4, -0.3, 0.2};
const Values held_p{0.1, 0.4, -0.2, 0.0, 0.3, -0.1};

/// The same without walls.
Chain free_chain() {
    std::vector<Bond<LineSpring>> bonds;
    for (std::int32_t i = 0; i < 5; ++i) bonds.push_back({i, i + 1, {.stiffness = 1.0, .quartic = 1.0}});
    return Chain({1.0, 0.5, 1.0, 0.8, 1.0, 2.0}, bonds);
}

/// An elastic string of n segments between (0, 0) and (n, 0), stretched by a tenth.
ElasticString string_of(int n) {
    std::vector<Bond<StringSegment>> bonds;
    for (std::int32_t i = -1; i < n - 1; ++i)
        bonds.push_back({i, i == n - 2 ? -1 : i + 1, {.stiffness = 2.0, .length = 0.9}, {1.0, 0.0}});
    return ElasticString(Values(static_cast<std::size_t>(2 * (n - 1)), 1.0), bonds);
}

/// q at `time` by many small steps of the fourth-order Runge-Kutta scheme.
template <class S>
Values reference(S& system, const Values& q_0, const Values& p_0, double time, int steps) {
    const std::size_t n = q_0.size();
    const double h = time / steps;
    Values q = q_0, p = p_0, f(n);
    const std::span<const double> m = system.inverse_mass();
    for (int i = 0; i < steps; ++i) {
        Values dq(n, 0.0), dp(n, 0.0), q_k = q, p_k = p;
        const double weights[] = {1.0, 2.0, 2.0, 1.0}, next[] = {0.5, 0.5, 1.0, 0.0};
        for (int k = 0; k < 4; ++k) {
            system.force(q_k, f);
            for (std::size_t j = 0; j < n; ++j) {
                const double v = m[j] * p_k[j];
                dq[j] += h / 6.0 * weights[k] * v;
                dp[j] += h / 6.0 * weights[k] * f[j];
                q_k[j] = q[j] + next[k] * h * v;
                p_k[j] = p[j] + next[k] * h * f[j];
            }
        }
        for (std::size_t j = 0; j < n; ++j) {
            q[j] += dq[j];
            p[j] += dp[j];
        }
    }
    return q;
}

double distance(std::span<const double> a, std::span<const double> b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) raise(worst, std::abs(a[i] - b[i]));
    return worst;
}

double total(std::span<const double> a, std::span<const double> b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += 0.5 * (a[i] + b[i]);
    return sum;
}

double rate(const std::function<double(int)>& error_of, int steps) {
    return std::log2(error_of(steps) / error_of(2 * steps));
}

}  // namespace

#define ABUT_ALL_INTEGRATORS \
    MemmExact, MemmGauss1, MemmGauss2, MemmGauss3, LeapfrogScheme, BilbaoScheme, EnergyMomentumScheme, AsyncScheme

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
    CHECK((error(800) < 1e-12 || error(400) / error(800) == Approx(4.0).epsilon(0.3)));
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

TEMPLATE_TEST_CASE("every integrator goes back the way that it came", "[dynamics][integrators]", ABUT_ALL_INTEGRATORS) {
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
        CHECK(growth(1.01 * TestType::stability / 2.0) > 1e6);
    } else {
        CHECK(growth(1.01) < 10.0);
        CHECK(growth(20.0) < 1e3);  // the start with a step far too long gives it speed; it grows no more
    }
}

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
        CHECK(coarse / fine == Approx(4.0).epsilon(0.25));
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
