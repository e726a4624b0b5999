// Compositions of MEMM's sub-flows: their orders, their energies, and where they end.
#include <catch2/catch.hpp>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/dynamics/composed.hpp"
#include "abut/dynamics/losses.hpp"
#include "dynamics/own_systems.hpp"

using namespace abut;
using namespace abut::test;
using Catch::Contains;
using dynamics::Composed;
using dynamics::Composition;
using dynamics::StepChange;

namespace {

constexpr std::array all_compositions{Composition::strang, Composition::suzuki_4, Composition::blanes_moan_4,
                                      Composition::blanes_moan_6};
constexpr std::array higher_orders{Composition::suzuki_4, Composition::blanes_moan_4, Composition::blanes_moan_6};

struct Outcome {
    double error, drift, energy_error;  // energies over |H0|
};

template <class Law>
Outcome run(KnownMotion<Law> motion, Composition composition, int steps, bool project = false,
            PathMean mean = PathMean::system) {
    Composed integrator(motion.system, motion.run.q, motion.run.p, motion.time / steps, composition, mean);
    const double start = start_energy(motion);
    Outcome outcome{};
    for (int i = 0; i < steps; ++i) {
        integrator.step();
        if (project) integrator.project();
        raise(outcome.drift, std::abs((integrator.pseudo_energy() - start) / start));
        raise(outcome.energy_error, std::abs((integrator.energy() - start) / start));
    }
    outcome.error = error_of(motion, integrator);
    return outcome;
}

/// Steps that take about so many forces.
int steps_of(Composition composition, int forces) {
    return static_cast<int>(std::lround(forces / static_cast<double>(dynamics::sub_flows(composition).size())));
}

template <class Law>
void check_order(const KnownMotion<Law>& motion, int forces) {
    for (const Composition composition : higher_orders)
        for (const bool project : {false, true}) {
            CAPTURE(name_of(composition), project, motion.time);
            const int steps = steps_of(composition, forces), order = order_of(composition);
            const Outcome coarse = run(motion, composition, steps, project),
                          fine = run(motion, composition, 2 * steps, project);
            CHECK(std::log2(coarse.error / fine.error) == Approx(order).margin(order == 6 ? 0.2 : 0.1));
            CHECK(std::max(coarse.drift, fine.drift) <= 1e-13);
            if (project) CHECK(std::max(coarse.energy_error, fine.energy_error) <= 1e-13);
        }
}

/// A chain of 100 masses with fixed ends, a bell of velocity that holds next to nothing of the upper half of the modes.
struct BellChain {
    static constexpr int n = 100;
    Chain system = row_of(n, {.stiffness = 1.0});
    Values q = Values(n, 0.0), p = Values(n);

    BellChain() {
        for (int i = 0; i < n; ++i) p[i] = std::exp(-std::pow((i - 30) / 8.0, 2));
    }
    /// Energy of the modes above the 50th, over that of all at the start.
    [[nodiscard]] double upper_half(const Composed<Chain>& run) const {
        double energy = 0.0, start = 0.0;
        for (const double p_i : p) start += 0.5 * p_i * p_i;
        for (int mode = n / 2 + 1; mode <= n; ++mode) {
            const double angle = std::numbers::pi * mode / (n + 1), omega = 2.0 * std::sin(0.5 * angle);
            double momentum = 0.0, position = 0.0;
            for (int i = 0; i < n; ++i) {
                const double shape = std::sqrt(2.0 / (n + 1)) * std::sin(angle * (i + 1));
                momentum += 0.5 * shape * (run.p_before()[i] + run.p_after()[i]);
                position += shape * run.q()[i];
            }
            energy += 0.5 * (momentum * momentum + omega * omega * position * position);
        }
        return energy / start;
    }
};

/// N-sync as `synchronise` has it, but with p = (a + b)/2 instead of b.
void synchronise_with_the_mean(Composed<Chain>& run, Chain& system) {
    dynamics::IntegratorState state = run.state();
    const std::size_t n = state.q.size();
    Values mean(n), ahead(n), behind(n), f_ahead(n), f_behind(n);
    for (std::size_t i = 0; i < n; ++i) {
        mean[i] = 0.5 * (state.p_before[i] + state.p_after[i]);
        ahead[i] = state.q[i] + 0.25 * state.dt * mean[i];
        behind[i] = state.q[i] - 0.25 * state.dt * mean[i];
    }
    system.force(ahead, f_ahead);
    system.force(behind, f_behind);
    for (std::size_t i = 0; i < n; ++i) {
        const double difference = state.dt / 8.0 * (f_ahead[i] - f_behind[i]);
        state.p_before[i] = mean[i] + 0.5 * difference;
        state.p_after[i] = mean[i] - 0.5 * difference;
    }
    run.restore(state);
}

/// q'' = -q + cos 2t from rest at 0, where q = (cos t - cos 2t)/3; its mean is exact in q and in t.
struct DrivenOscillator {
    std::vector<double> inverse_masses{1.0};
    std::size_t size() const { return 1; }
    std::span<const double> inverse_mass() const { return inverse_masses; }
    bool mean_is_exact() const { return true; }
    double potential(std::span<const double> q) const { return 0.5 * q[0] * q[0]; }
    void force(std::span<const double> q, std::span<double> f) const { f[0] = 1.0 - q[0]; }
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double t, double dt,
                    std::span<double> f) const {
        f[0] = -0.5 * (q_0[0] + q_1[0]) + 0.5 * (std::sin(2.0 * (t + dt)) - std::sin(2.0 * t)) / dt;
    }
};

/// A spring that says what compositions refuse.
struct Lossy : DrivenOscillator {
    dynamics::Losses dissipated() const { return {}; }
};
struct Loaded : DrivenOscillator {
    double work() const { return 0.0; }
};
struct Followed : Loaded {
    void end_force(std::span<const double>, std::span<const double> q_1, double, double, std::span<double> f) const {
        force(q_1, f);
    }
    bool is_autonomous() const { return true; }
};
struct Rigid : DrivenOscillator {
    bool has_constraints() const { return true; }
    bool is_constrained(std::int32_t) const { return true; }
    void constrain_along(std::span<const double>, double, std::span<double>) const {}
    void constrain_at(std::span<const double>, double, std::span<double>) const {}
};

template <class S>
void compose(S system) {
    Composed<S>(system, {0.0}, std::vector{0.0}, 0.1, Composition::strang);
}

}  // namespace

TEST_CASE("compositions have orders 4 and 6 on Kepler, with H~ or H at round-off", "[dynamics][composed]") {
    check_order(kepler_motion(), 6888);
}
TEST_CASE("compositions have orders 4 and 6 on the chain of Fermi, Pasta and Ulam, with H~ or H at round-off",
          "[dynamics][composed]") {
    check_order(chain_motion(), 861);
}
TEST_CASE("compositions have orders 4 and 6 on Duffing, with H~ or H at round-off", "[dynamics][composed]") {
    check_order(duffing_motion(), 1722);
}

TEST_CASE("compositions go where the formulas of their sub-flows alone lead", "[dynamics][composed]") {
    const auto check = [](const auto& known, const Doubled::Force& force, int panels, int forces) {
        for (const Composition composition : all_compositions) {
            const int steps = steps_of(composition, forces);
            CAPTURE(name_of(composition), known.time, steps);
            auto motion = known;
            Composed integrator(motion.system, motion.run.q, motion.run.p, motion.time / steps, composition);
            Doubled doubled(force, panels, motion.run.q, motion.run.p);
            for (int i = 0; i < steps; ++i) {
                integrator.step();
                for (const auto& [kicks_a, length] : dynamics::sub_flows(composition))
                    doubled.flow(kicks_a, length * motion.time / steps);
            }
            CHECK(doubled.distance(integrator.q(), integrator.p_before(), integrator.p_after()) < 1e-10);
        }
    };
    check(duffing_motion(), force_of_duffing, 1, 1722);
    check(chain_motion(), force_of_chain, 1, 861);
    check(kepler_motion(), force_of_kepler, 40, 3444);
}

TEST_CASE("a higher order errs less for as many forces where the motion is smooth", "[dynamics][composed]") {
    const auto errors_fall = [](const auto& motion, int forces) {
        double last = std::numeric_limits<double>::infinity();
        for (const Composition composition : {Composition::strang, Composition::blanes_moan_4, Composition::blanes_moan_6}) {
            const double error = run(motion, composition, steps_of(composition, forces)).error;
            CHECK(error < 0.1 * last);
            last = error;
        }
    };
    errors_fall(kepler_motion(), 3444);
    errors_fall(duffing_motion(), 1722);
    errors_fall(chain_motion(), 1722);
}

TEST_CASE("with a discrete gradient that is no path mean whole steps keep order 4, and merged ones would have 2",
          "[dynamics][composed]") {
    const auto order = [](const auto& motion, Composition composition, int forces) {
        const int steps = steps_of(composition, forces);
        const Outcome coarse = run(motion, composition, steps), fine = run(motion, composition, 2 * steps);
        CHECK(std::max(coarse.drift, fine.drift) <= 1e-13);
        return std::log2(coarse.error / fine.error);
    };
    const auto honest = kepler_motion<CentralGradient<false>>();
    const auto wrong = kepler_motion<CentralGradient<true>>();  // it claims to be one
    CHECK(order(honest, Composition::suzuki_4, 6888) >= 3.9);
    CHECK(order(wrong, Composition::blanes_moan_4, 6888) == Approx(2.0).margin(0.1));
    CHECK(order(wrong, Composition::blanes_moan_6, 6888) == Approx(2.0).margin(0.1));
    CHECK_THROWS_WITH(run(honest, Composition::blanes_moan_4, 10), Contains("blanes_moan_4") && Contains("Take suzuki_4"));
    CHECK_THROWS_AS(run(honest, Composition::blanes_moan_6, 10), BadInput);
}

TEST_CASE("a mean by Gauss points keeps the order with half as many points, and fewer are refused", "[dynamics][composed]") {
    const auto order = [](Composition composition, PathMean mean) {
        const int steps = steps_of(composition, 6888);
        const auto motion = kepler_motion<CentralGradient<false>>();
        return std::log2(run(motion, composition, steps, false, mean).error /
                         run(motion, composition, 2 * steps, false, mean).error);
    };
    CHECK(order(Composition::blanes_moan_4, PathMean::gauss_2) == Approx(4.0).margin(0.1));
    CHECK(order(Composition::blanes_moan_6, PathMean::gauss_3) == Approx(6.0).margin(0.2));
    CHECK(order(Composition::suzuki_4, PathMean::gauss_1) == Approx(4.0).margin(0.1));
    CHECK_THROWS_WITH(order(Composition::blanes_moan_6, PathMean::gauss_2),
                      Contains("2 Gauss points") && Contains("order 6 takes 3"));
    CHECK_THROWS_AS(order(Composition::blanes_moan_4, PathMean::gauss_1), BadInput);
}

TEST_CASE("a force that depends on time keeps the order", "[dynamics][composed]") {
    const auto error = [](Composition composition, int steps) {
        DrivenOscillator system;
        Composed integrator(system, {0.0}, std::vector{0.0}, 3.0 / steps, composition);
        for (int i = 0; i < steps; ++i) integrator.step();
        return std::abs(integrator.q()[0] - (std::cos(3.0) - std::cos(6.0)) / 3.0);
    };
    for (const Composition composition : higher_orders) {
        const int order = order_of(composition);
        CHECK(std::log2(error(composition, 20) / error(composition, 40)) == Approx(order).margin(order == 6 ? 0.2 : 0.1));
    }
}

TEST_CASE("compositions are stable up to where the matrix of their splitting is: 4, 5.44 and 6.26", "[dynamics][composed]") {
    const auto is_stable = [](Composition composition, double dt) {
        Splitting step;
        for (const auto& [kicks_a, length] : dynamics::sub_flows(composition)) step.flow(kicks_a, length * dt);
        return std::abs(step.trace()) <= 2.0;
    };
    const auto growth = [](Composition composition, double dt) {
        Chain oscillator({1.0}, {{-1, 0, {.stiffness = 1.0}}});
        Composed integrator(oscillator, {1.0}, std::vector{0.3}, dt, composition);
        double largest = 0.0;
        for (int i = 0; i < 3000; ++i) {
            integrator.step();
            raise(largest, std::abs(integrator.q()[0]));
        }
        return largest;
    };
    const std::array known{4.0, 5.44, 6.26, 6.26};  // docs/integrators.md
    for (std::size_t i = 0; i < known.size(); ++i) {
        const Composition composition = all_compositions[i];
        CAPTURE(name_of(composition));
        double limit = 0.01;
        while (is_stable(composition, limit + 1e-4)) limit += 1e-4;
        double last_unstable = limit + 1e-4;  // above it some are stable again
        while (last_unstable < limit + 0.1 && !is_stable(composition, last_unstable + 1e-4)) last_unstable += 1e-4;
        CHECK(limit == Approx(known[i]).margin(0.01));
        CHECK(growth(composition, 0.99 * limit) < 100.0);
        CHECK_FALSE(growth(composition, 0.5 * (limit + last_unstable)) < 1e6);
    }
}

TEST_CASE("the difference between both copies grows in proportion to time on an orbit, and not where they are projected",
          "[dynamics][composed]") {
    const auto growth = [](bool project) {  // of H - H~ = |a - b|^2/8 from 10 to 100 orbits
        auto motion = kepler_motion();
        Composed integrator(motion.system, motion.run.q, motion.run.p, 0.1, Composition::blanes_moan_4);
        double excess = 0.0, after_ten = 0.0;
        while (integrator.time() < 200.0 * std::numbers::pi) {
            integrator.step();
            raise(excess, integrator.energy_excess());
            if (project) integrator.project();
            if (integrator.time() < 20.0 * std::numbers::pi) after_ten = excess;
        }
        return excess / after_ten;
    };
    CHECK(growth(false) == Approx(100.0).epsilon(0.2));
    CHECK(growth(true) == Approx(1.0).epsilon(0.1));
}

TEST_CASE("a projection leaves a rigid part of the momenta as it is", "[dynamics][composed]") {
    Chain chain = free_chain();
    const Values p{0.5, 0.4, 0.1, 0.3, 0.6, 0.2};
    Composed integrator(chain, held_q, p, 0.4, Composition::blanes_moan_4);
    const double start = integrator.energy();
    double mass = 0.0;
    for (const double inverse : chain.inverse_mass()) mass += 1.0 / inverse;
    Values rigid(p.size());
    for (std::size_t i = 0; i < rigid.size(); ++i) rigid[i] = 2.1 / mass / chain.inverse_mass()[i];
    double drift = 0.0, energy_error = 0.0;
    for (int i = 0; i < 200; ++i) {
        integrator.step();
        REQUIRE(integrator.energy_excess() > 0.0);
        integrator.project(rigid);
        raise(drift, std::abs(total(integrator.p_before(), integrator.p_after()) - 2.1));
        raise(energy_error, std::abs(integrator.energy() - start) / start);
    }
    CHECK(drift < 1e-13);
    CHECK(energy_error < 1e-13);
    CHECK(integrator.projections().done == 200);
    integrator.step(4.0, StepChange::keep);
    const double before = total(integrator.p_before(), integrator.p_after());
    CHECK_THROWS_WITH(integrator.project(Values{1.0}), Contains("a rigid part of 1 momenta"));
    CHECK(total(integrator.p_before(), integrator.p_after()) == before);
}

TEST_CASE("at rest and at turning points a projection is skipped and counted, and changes nothing", "[dynamics][composed]") {
    auto motion = duffing_motion();
    Composed integrator(motion.system, motion.run.q, motion.run.p, 0.4, Composition::strang);
    CHECK_FALSE(integrator.project());
    CHECK(integrator.p_before()[0] == 0.0);
    bool was_skipped = false;
    for (int i = 0; i < 200 && !was_skipped; ++i) {
        integrator.step();
        const double a = integrator.p_before()[0], b = integrator.p_after()[0];
        const double kinetic = 0.125 * (a + b) * (a + b), excess = 0.125 * (a - b) * (a - b);
        was_skipped = !integrator.project();
        CHECK(was_skipped == (excess > 0.25 * kinetic));
        if (was_skipped) CHECK((integrator.p_before()[0] == a && integrator.p_after()[0] == b));
    }
    CHECK(was_skipped);
    CHECK(integrator.projections().skipped == 2);
}

TEST_CASE("a wave keeps its modes where the alternating mode is taken out with b, not with p, and not by a = b",
          "[dynamics][composed]") {
    const auto upper_half = [](const auto& after_step) {
        BellChain bell;
        Composed integrator(bell.system, bell.q, bell.p, 2.0 * 0.85, Composition::strang);
        const double start = integrator.pseudo_energy();
        for (int i = 0; i < 20000 / 3 && integrator.energy_excess() < start; ++i) {
            integrator.step();
            after_step(integrator, bell.system);
        }
        if (integrator.synchronisations().done > 0) {
            CHECK(integrator.synchronisations().done == 20000 / 3);
            CHECK(std::abs(integrator.pseudo_energy() - start) < 1e-13 * start);
        }
        return bell.upper_half(integrator);
    };
    using Run = Composed<Chain>;
    CHECK(upper_half([](Run& run, Chain&) { run.synchronise(); }) <= 1e-15);
    CHECK(upper_half([](Run& run, Chain&) { run.project(); }) > 0.5);
    CHECK(upper_half(synchronise_with_the_mean) > 0.5);
}

TEST_CASE("the alternating mode that can be paid in part only is taken in part, and at rest not at all",
          "[dynamics][composed]") {
    Chain oscillator({1.0}, {{-1, 0, {.stiffness = 1.0}}});
    Composed integrator(oscillator, {1.0}, std::vector{0.1}, 0.5, Composition::strang);
    dynamics::IntegratorState state = integrator.state();
    state.p_before[0] = 1.1;  // p = 0.1, |a - b|^2/8 = 0.5
    state.p_after[0] = -0.9;
    integrator.restore(state);
    const double start = integrator.pseudo_energy();
    CHECK(integrator.synchronise());
    CHECK(integrator.synchronisations().shortened == 1);
    CHECK(integrator.pseudo_energy() == Approx(start).margin(1e-15));  // of terms of 0.5
    CHECK(integrator.energy_excess() < 0.5);
    state.p_before[0] = 1.0;
    state.p_after[0] = -1.0;  // p = 0
    integrator.restore(state);
    CHECK_FALSE(integrator.synchronise());
    CHECK(integrator.synchronisations().skipped == 1);
    CHECK(integrator.p_before()[0] == 1.0);
}

TEST_CASE("a composition goes back the way it came with the signs of both copies turned, and not with them exchanged",
          "[dynamics][composed]") {
    const auto distance_after = [](Composition composition, bool exchange) {
        auto motion = kepler_motion();
        Composed integrator(motion.system, motion.run.q, motion.run.p, 0.02, composition);
        for (int i = 0; i < 500; ++i) integrator.step();
        integrator.reverse();
        dynamics::IntegratorState state = integrator.state();
        if (exchange) std::swap(state.p_before, state.p_after);
        integrator.restore(state);
        for (int i = 0; i < 500; ++i) integrator.step();
        return distance(integrator.q(), motion.run.q);
    };
    for (const Composition composition : all_compositions) CHECK(distance_after(composition, false) <= 1e-13);
    CHECK(distance_after(Composition::strang, true) > 1e-8);
}

TEST_CASE("compositions refuse systems that no sub-step may lead back, each by its reason", "[dynamics][composed][errors]") {
    CHECK_NOTHROW(compose(DrivenOscillator()));
    CHECK_THROWS_WITH(compose(Lossy()), Contains("losses") && Contains("Take Memm"));
    CHECK_THROWS_WITH(compose(Loaded()), Contains("work from outside"));
    CHECK_THROWS_WITH(compose(Followed()), Contains("led along every step"));
    CHECK_THROWS_WITH(compose(Rigid()), Contains("constraints"));
    auto motion = duffing_motion();
    Composed integrator(motion.system, motion.run.q, motion.run.p, 0.1, Composition::blanes_moan_4);
    CHECK_THROWS_WITH(integrator.synchronise(), Contains("known for strang alone"));
    CHECK_THROWS_AS(integrator.synchronise(), Misuse);
}
