// Steps whose length changes, taken in pairs of sub-steps.
#include <catch2/catch.hpp>
#include <random>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/dynamics/composed.hpp"
#include "abut/dynamics/pairs.hpp"
#include "dynamics/own_systems.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using dynamics::Composed;
using dynamics::Composition;
using dynamics::Memm;
using dynamics::Pairs;
using dynamics::StepChange;

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// Steps of 0.4 and 1.6 of `mean` in turn, or at random between 0.2 and 1.8 of it, up to `end`.
std::vector<double> steps(double mean, double end, bool at_random) {
    std::mt19937 random(3);
    std::vector<double> steps;
    for (double t = 0.0; t < end - 1e-12; t += steps.back()) {
        const double part = at_random               ? 0.2 + 1.6 * static_cast<double>(random()) / std::mt19937::max()
                            : steps.size() % 2 == 0 ? 0.4
                                                    : 1.6;
        steps.push_back(std::min(part * mean, end - t));
    }
    return steps;
}

struct PairsOutcome {
    double error, drift;
};

PairsOutcome run_duffing(double mean, bool at_random) {
    auto motion = duffing_motion();
    Pairs pairs(motion.system, motion.run.q, motion.run.p, unknown);
    const double start = start_energy(motion);
    double drift = 0.0;
    for (const double d : steps(mean, motion.time, at_random)) {
        pairs.step(d);
        raise(drift, std::abs(pairs.pseudo_energy() - start) / start);
    }
    CHECK(pairs.time() == Approx(motion.time).epsilon(1e-13));
    const auto state = pairs.synchronised();
    return {std::sqrt(motion.run.squared_error(state.q, state.p_before, state.p_after)), drift};
}

/// Distance from `motion` of Duffing's oscillator under MEMM.
double run_memm(const KnownMotion<LineSpring>& motion, double mean, StepChange change) {
    auto oscillator = duffing_motion();
    const auto lengths = steps(mean, oscillator.time, false);
    Memm memm(oscillator.system, oscillator.run.q, oscillator.run.p, lengths.front());
    for (const double d : lengths) memm.step(d, change);
    return error_of(motion, memm);
}

/// H - H~ over K0 at most in 5,000 steps of 1.3 h/c of a chain of 100; `exchanges` takes B A B after A B A.
double largest_excess(bool exchanges) {
    constexpr int n = 100;
    Chain chain = row_of(n, {.stiffness = 1.0});
    Values p(n);
    for (int i = 0; i < n; ++i) p[i] = std::exp(-std::pow((i - 30) / 8.0, 2));
    Composed run(chain, Values(n, 0.0), p, 1.3, Composition::strang);
    const double start = run.energy();
    double excess = 0.0;
    for (int i = 0; i < 5000 && excess <= 1e3; ++i) {
        run.step();
        raise(excess, run.energy_excess() / start);
        if (!exchanges) continue;
        dynamics::IntegratorState state = run.state();
        std::swap(state.p_before, state.p_after);
        run.restore(state);
    }
    return excess;
}

/// A spring whose n-th mean force from now on throws; none if n is 0.
struct FailingSpring {
    Values inverse_masses{1.0};
    int fails_at = 0;
    std::size_t size() const { return 1; }
    std::span<const double> inverse_mass() const { return inverse_masses; }
    double potential(std::span<const double> q) const { return 0.5 * q[0] * q[0]; }
    void force(std::span<const double> q, std::span<double> f) const { f[0] = -q[0]; }
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double, std::span<double> f) {
        if (fails_at > 0 && --fails_at == 0) throw Diverged("lost");
        f[0] = -0.5 * (q_0[0] + q_1[0]);
    }
};

bool are_equal(const dynamics::IntegratorState& a, const dynamics::IntegratorState& b) {
    return a.q == b.q && a.p_before == b.p_before && a.p_after == b.p_after && a.dt == b.dt && a.time == b.time &&
           a.steps == b.steps && a.restart_jumps == b.restart_jumps && a.of_scheme == b.of_scheme;
}

Chain oscillator() { return Chain({1.0}, {{-1, 0, {.stiffness = 1.0}}}); }

}  // namespace

TEST_CASE("pairs keep order 2 and H~ under steps that vary", "[dynamics][pairs]") {
    for (const bool at_random : {false, true}) {
        const PairsOutcome coarse = run_duffing(0.025, at_random), fine = run_duffing(0.00625, at_random);
        CHECK(0.5 * std::log2(coarse.error / fine.error) == Approx(2.0).margin(0.05));
        CHECK(std::max(coarse.drift, fine.drift) <= 2e-14);
    }
}

TEST_CASE("pairs go where the formulas of their sub-steps alone lead", "[dynamics][pairs]") {
    for (const bool at_random : {false, true}) {
        auto motion = duffing_motion();
        Pairs pairs(motion.system, motion.run.q, motion.run.p, unknown);
        Doubled doubled(force_of_duffing, 1, motion.run.q, motion.run.p);
        for (const double d : steps(0.1, motion.time, at_random)) {
            pairs.step(d);
            doubled.step(d);
        }
        const auto state = pairs.synchronised();
        CHECK(doubled.distance(state.q, state.p_before, state.p_after) < 1e-11);
    }
}

TEST_CASE("under steps of a and b in turn MEMM with its momenta kept moves masses that are (a + b)^2/(4 a b) times as large",
          "[dynamics][pairs]") {
    // Steps of a are led by p^- + 2 b F, those of b by p^- + 2 a F: q' = 4 a b/(a + b)^2 p/m where p' = F.
    constexpr double a = 0.4, b = 1.6, heavier = (a + b) * (a + b) / (4.0 * a * b);
    const auto right = duffing_motion();
    Chain heavy({1.0 / heavier}, {{-1, 0, {.stiffness = 1.0, .quartic = 1.0}}});
    const KnownMotion<LineSpring> wrong{
        heavy, studies::orders::run_by_small_steps(heavy, right.run.q, right.run.p, right.time, 100000), right.time};
    const double coarse = run_memm(wrong, 0.025, StepChange::keep), fine = run_memm(wrong, 0.0125, StepChange::keep);
    CHECK(fine < 0.6 * coarse);
    CHECK(fine < 0.05 * run_memm(right, 0.0125, StepChange::keep));
}

TEST_CASE("under steps that vary restarts converge, and move H~", "[dynamics][pairs]") {
    auto motion = duffing_motion();
    const double coarse = run_memm(motion, 0.025, StepChange::restart), fine = run_memm(motion, 0.0125, StepChange::restart);
    CHECK(std::log2(coarse / fine) == Approx(2.0).margin(0.3));
    Memm memm(motion.system, motion.run.q, motion.run.p, 0.04);
    for (const double d : steps(0.1, motion.time, false)) memm.step(d, StepChange::restart);
    CHECK(std::abs(memm.restart_jumps()) > 1e-3);
}

TEST_CASE("pairs keep order 2 and H~ with a discrete gradient, on a geometrically exact string", "[dynamics][pairs]") {
    ElasticString string = string_of(5);
    const Values q{0.0, 0.3, 0.1, 0.4, 0.0, 0.2, -0.1, 0.1}, p(8, 0.0);
    const double end = 4.0;
    const Values exact = reference(string, q, p, end, 20000);
    const auto error = [&](double mean) {
        Pairs pairs(string, q, p, unknown);
        const double start = pairs.pseudo_energy();
        double drift = 0.0;
        for (const double d : steps(mean, end, false)) {
            pairs.step(d);
            raise(drift, std::abs(pairs.pseudo_energy() - start) / start);
        }
        CHECK(drift <= 1e-13);
        return distance(pairs.q(), exact);
    };
    CHECK(std::log2(error(0.02) / error(0.01)) == Approx(2.0).margin(0.05));
}

TEST_CASE("a kick that is held back changes nothing: pairs are A B A with 3 forces, and cost 2", "[dynamics][pairs]") {
    auto motion = duffing_motion(), other = duffing_motion();
    Pairs pairs(motion.system, motion.run.q, motion.run.p, unknown);
    Composed three(other.system, other.run.q, other.run.p, 1.0, Composition::strang);
    const auto lengths = steps(0.05, motion.time, true);
    const std::int64_t before = motion.system.evaluations();
    double worst = 0.0;
    for (const double d : lengths) {
        pairs.step(d);
        three.step(d, StepChange::keep);
        raise(worst, std::abs(pairs.q()[0] - three.q()[0]));
    }
    CHECK(motion.system.evaluations() - before == 2 * static_cast<std::int64_t>(lengths.size()));
    const auto state = pairs.synchronised();
    raise(worst, std::abs(state.p_before[0] - three.p_before()[0]));
    raise(worst, std::abs(state.p_after[0] - three.p_after()[0]));
    CHECK(worst < 1e-12);
    CHECK(state.q[0] == pairs.q()[0]);
}

TEST_CASE("A B A in every step holds where A B A and B A B in turn are lost", "[dynamics][pairs]") {
    CHECK(largest_excess(false) <= 1e-4);
    CHECK(largest_excess(true) > 1e3);
}

TEST_CASE("random steps pump an oscillator as products of its matrices grow, and H~ does not see it", "[dynamics][pairs]") {
    constexpr std::int64_t n = 2'000'000;
    Chain spring = oscillator();
    Pairs pairs(spring, {1.0}, std::vector{0.3}, 2.0);
    Splitting product;
    std::mt19937 random(1);
    double log_growth = 0.0, log_of_product = 0.0, drift = 0.0;
    for (std::int64_t i = 1; i <= n; ++i) {
        const double d = 0.6 + 1.8 * static_cast<double>(random()) / std::mt19937::max();
        pairs.step(d);
        product.step(d);
        if (i == 500) drift = std::abs(pairs.pseudo_energy() / 0.545 - 1.0);
        if (i % 1000 != 0) continue;
        dynamics::IntegratorState state = pairs.state();
        const double size = std::max({std::abs(state.q[0]), std::abs(state.p_before[0]), std::abs(state.p_after[0])});
        log_growth += std::log(size);
        for (auto* values : {&state.q, &state.p_before, &state.p_after}) (*values)[0] /= size;
        pairs.restore(state);
        log_of_product += std::log(product.norm());
        product.divide_by(product.norm());
    }
    CHECK(log_growth == Approx(2.0 * log_of_product).epsilon(0.01));  // q, a and b are products of x and y
    CHECK(log_growth > 1000.0);
    CHECK(drift < 1e-12);
    CHECK(pairs.report().may_grow);
}

TEST_CASE("pairs warn of modes that may grow after ten changes of a step above a quarter of the stable one",
          "[dynamics][pairs]") {
    const auto report = [](double d, double factor, int n) {
        Chain spring = oscillator();
        Pairs pairs(spring, {1.0}, std::vector{0.3}, 2.0);
        for (int i = 0; i < n; ++i) pairs.step(i % 2 == 0 ? d : factor * d);
        return pairs.report();
    };
    CHECK(report(0.6, 1.2, 12).may_grow);
    CHECK(report(0.6, 1.2, 12).changes == 11);
    CHECK(report(0.6, 1.2, 12).longest == Approx(0.72));
    CHECK_FALSE(report(0.6, 1.2, 11).may_grow);
    CHECK_FALSE(report(0.6, 1.05, 100).may_grow);
    CHECK_FALSE(report(0.4, 1.2, 100).may_grow);
    // Steps that change slowly are compared with the last one counted.
    Chain spring = oscillator();
    Pairs pairs(spring, {1.0}, std::vector{0.3}, 2.0);
    for (int i = 0; i < 400; ++i) pairs.step(0.6 * (1.0 + 0.3 * std::sin(0.1 * i)));
    CHECK(pairs.report().may_grow);
}

TEST_CASE("a load that varies from step to step acts with order 2", "[dynamics][pairs]") {
    constexpr double end = 3.0;  // q'' = -q + cos 2t from rest at 0: q = (cos t - cos 2t)/3
    struct Loaded {
        Values inverse_masses{1.0};
        double load = 0.0;
        std::size_t size() const { return 1; }
        std::span<const double> inverse_mass() const { return inverse_masses; }
        double potential(std::span<const double> q) const { return 0.5 * q[0] * q[0]; }
        void force(std::span<const double> q, std::span<double> f) const { f[0] = load - q[0]; }
        void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double,
                        std::span<double> f) const {
            f[0] = load - 0.5 * (q_0[0] + q_1[0]);
        }
    };
    const auto error = [](double mean) {
        Loaded system;
        Pairs pairs(system, {0.0}, std::vector{0.0}, unknown);
        double last = 0.0;
        for (const double d : steps(mean, end, true)) {
            const double now = std::cos(2.0 * (pairs.time() + 0.5 * d));
            pairs.step(d,
                       [&](double before, double after) { system.load = (before * last + after * now) / (before + after); });
            last = now;
        }
        return std::abs(pairs.q()[0] - (std::cos(end) - std::cos(2.0 * end)) / 3.0);
    };
    CHECK(0.5 * std::log2(error(0.04) / error(0.01)) == Approx(2.0).margin(0.2));
}

TEST_CASE("pairs go on bitwise identical from a saved state, and after a look at their momenta", "[dynamics][pairs]") {
    Chain chain = held_chain(), other = held_chain();
    Pairs pairs(chain, held_q, held_p, unknown), restored(other, Values(6, 0.0), Values(6, 0.0), unknown);
    const auto lengths = steps(0.1, 2.0, true);
    const std::size_t half = lengths.size() / 2;
    for (std::size_t i = 0; i < half; ++i) pairs.step(lengths[i]);
    restored.restore(pairs.state());
    for (std::size_t i = half; i < lengths.size(); ++i) {
        pairs.step(lengths[i]);
        restored.step(lengths[i]);
        static_cast<void>(restored.synchronised());
    }
    CHECK(std::ranges::equal(pairs.q(), restored.q()));
    CHECK(pairs.state().p_before == restored.state().p_before);
    CHECK(pairs.time() == restored.time());
    CHECK(restored.steps() == static_cast<std::int64_t>(lengths.size()));
    CHECK_FALSE(std::ranges::equal(pairs.q(), held_q));
}

TEST_CASE("where a force or a load throws, pairs stay as they are and go on bitwise identical",
          "[dynamics][pairs][errors]") {
    FailingSpring system, undisturbed;
    Pairs pairs(system, {1.0}, std::vector{0.3}, 2.0), other(undisturbed, {1.0}, std::vector{0.3}, 2.0);
    for (int i = 0; i < 5; ++i) {
        const dynamics::IntegratorState before = pairs.state();
        for (const int n : {1, 2}) {
            system.fails_at = n;
            CHECK_THROWS_AS(pairs.step(0.1), Diverged);
            CHECK(are_equal(pairs.state(), before));
            int loads = 0;
            const auto load = [&](double, double) {
                if (++loads == n) throw BadInput("no load");
            };
            CHECK_THROWS_AS(pairs.step(0.1, load), BadInput);
            CHECK(are_equal(pairs.state(), before));
        }
        if (i > 0) {
            system.fails_at = 1;
            CHECK_THROWS_AS(pairs.synchronised(), Diverged);
            system.fails_at = 1;
            CHECK_THROWS_AS(pairs.pseudo_energy(), Diverged);
        }
        CHECK(are_equal(pairs.state(), before));
        CHECK(pairs.report().longest == other.report().longest);
        pairs.step(0.1 + 0.05 * i);
        other.step(0.1 + 0.05 * i);
        CHECK(are_equal(pairs.state(), other.state()));
        CHECK(are_equal(pairs.synchronised(), other.synchronised()));
    }
}

TEST_CASE("pairs refuse steps and states that are none, by name, and stay as they are", "[dynamics][pairs][errors]") {
    Chain spring = oscillator();
    Pairs pairs(spring, {1.0}, std::vector{0.3}, 2.0);
    pairs.step(0.1);
    const dynamics::IntegratorState good = pairs.state();
    for (const double d : {0.0, -0.1, std::nan(""), unknown})
        CHECK_THROWS_WITH(pairs.step(d), Contains("time step is") && Contains("> 0"));
    dynamics::IntegratorState wrong = good;
    wrong.of_scheme.clear();
    CHECK_THROWS_WITH(pairs.restore(wrong), Contains("Pairs") && Contains("held back"));
    wrong = good;
    wrong.dt = 0.1;
    CHECK_THROWS_WITH(pairs.restore(wrong), Contains("path of 0.025 s") && Contains("dt is 0.1 s"));
    wrong = good;
    wrong.q[0] = std::nan("");
    CHECK_THROWS_AS(pairs.restore(wrong), BadInput);
    CHECK(pairs.state().q == good.q);
    CHECK(pairs.state().p_before == good.p_before);
    CHECK(pairs.state().of_scheme == good.of_scheme);
    CHECK(pairs.steps() == 1);
    const auto make = [&](double stable_step) { Pairs(spring, {1.0}, std::vector{0.3}, stable_step); };
    for (const double stable_step : {0.0, -1.0, std::nan("")}) CHECK_THROWS_WITH(make(stable_step), Contains("stable step"));
}
