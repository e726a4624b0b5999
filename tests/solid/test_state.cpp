// A run that is saved and goes on elsewhere has the bits of the run that was not stopped.
#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm_async.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/local_steps.hpp"
#include "solid/stacked_scenes.hpp"

using namespace abut;
using namespace abut::test;
using solid::Kinematics;

namespace {

struct MakeMemm {
    template <class Solid>
    auto operator()(Solid& solid, const std::vector<double>& p, double dt) const {
        return dynamics::Memm<Solid>(solid, std::vector<double>(solid.size(), 0.0), p, dt);
    }
};
struct MakeLeapfrog {
    template <class Solid>
    auto operator()(Solid& solid, const std::vector<double>& p, double dt) const {
        return dynamics::Leapfrog<Solid>(solid, std::vector<double>(solid.size(), 0.0), p, dt);
    }
};
struct MakeBilbao {
    template <class Solid>
    auto operator()(Solid& solid, const std::vector<double>& p, double dt) const {
        return dynamics::Bilbao<Solid>(solid, std::vector<double>(solid.size(), 0.0), p, dt, 10.0);
    }
};
struct MakeAsync {
    template <class Solid>
    auto operator()(Solid& solid, const std::vector<double>& p, double) const {
        auto local = solid::local_steps(solid, dynamics::stable_step(solid), {.contact_levels = 1});
        return dynamics::MemmAsync<Solid>(solid, std::vector<double>(solid.size(), 0.0), p, 0.7 * local.dt, local.steps);
    }
};

template <int Dim>
constexpr int n_steps = Dim == 2 ? 300 : 150;

/// Saves a run of `steps` steps at many of them, and goes on from each; how many pairs were in contact at those, together.
template <int Dim, class Make>
std::int64_t compare_with_restarts(const solid::SolidOptions<Dim>& options, const Make& make, int steps, int every) {
    const mesh::Mesh<Dim> mesh = stacked<Dim>();
    struct Run {
        Run(const mesh::Mesh<Dim>& mesh, const solid::SolidOptions<Dim>& options, const Make& make)
            : solid(mesh, options),
              integrator(make(solid, momentum_of(solid, thrown<Dim>()), 0.7 * dynamics::stable_step(solid).dt)) {}
        solid::Solid<Dim> solid;
        decltype(make(solid, std::vector<double>{}, 0.0)) integrator;
    };
    struct Saved {
        dynamics::IntegratorState motion;
        std::vector<std::byte> solid;
    };
    Run whole(mesh, options, make);
    std::vector<Saved> saved;
    std::int64_t pairs = 0;
    for (int i = 0; i < steps; ++i) {
        push(whole.solid, i);
        whole.integrator.step();
        if (i % every != 0) continue;
        saved.push_back({whole.integrator.state(), whole.solid.state()});
        pairs += whole.solid.contact_counts().active_pairs;
    }
    const auto at_end = dynamics::ledger_values(dynamics::measure(whole.integrator, whole.solid));
    for (const Saved& from : saved) {
        Run other(mesh, options, make);
        other.integrator.restore(from.motion);
        other.solid.restore(from.solid, other.integrator.q());
        while (other.integrator.steps() < steps) {
            push(other.solid, other.integrator.steps());
            other.integrator.step();
        }
        CAPTURE(from.motion.steps);
        REQUIRE(std::ranges::equal(other.integrator.q(), whole.integrator.q()));
        REQUIRE(std::ranges::equal(other.integrator.p_after(), whole.integrator.p_after()));
        REQUIRE(dynamics::ledger_values(dynamics::measure(other.integrator, other.solid)) == at_end);
        REQUIRE(other.solid.contact().report().events == whole.solid.contact().report().events);
        REQUIRE(other.solid.work() == whole.solid.work());
        REQUIRE(other.solid.outside_work(other.integrator.q()).steps ==
                whole.solid.outside_work(whole.integrator.q()).steps);
        REQUIRE(other.solid.outside_work(other.integrator.q()).changes ==
                whole.solid.outside_work(whole.integrator.q()).changes);
        REQUIRE(std::ranges::equal(other.solid.contact().impulses(), whole.solid.contact().impulses(), {},
                                   &solid::BodyImpulse<Dim>::impulse, &solid::BodyImpulse<Dim>::impulse));
        REQUIRE(other.solid.evaluations() == whole.solid.evaluations());
    }
    return pairs;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("bodies of all kinematics go on with the same bits from any step", "[solid][state]", ((int Dim), Dim),
                       2, 3) {
    const auto [name, kinematics] =
        GENERATE(table<std::string, std::vector<Kinematics>>({{"small", {Kinematics::small, Kinematics::small}},
                                                              {"floating", {Kinematics::floating, Kinematics::floating}},
                                                              {"finite", {Kinematics::finite, Kinematics::finite}},
                                                              {"rigid", {Kinematics::rigid, Kinematics::rigid}},
                                                              {"mixed", {Kinematics::floating, Kinematics::rigid}}}));
    CAPTURE(name);
    CHECK(compare_with_restarts<Dim>(falling<Dim>(kinematics), MakeMemm{}, n_steps<Dim>, 23) > 0);
}

TEMPLATE_TEST_CASE_SIG("so do runs of metal that flows and is damped", "[solid][state]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite);
    CAPTURE(static_cast<int>(kinematics));
    auto options = falling<Dim>({kinematics, kinematics});
    options.law = solid::ContactLaw::pair_potential;
    for (solid::Material& material : options.materials) {
        material.law = solid::MaterialLaw::j2;
        material.flow.yield_stress = 2e-3 * material.young;
        material.flow.hardening = 0.05 * material.young;
        material.damping.mass = 0.01;
        material.damping.stiffness = 0.01;
        material.damping.quadratic_viscosity = 1.0;
    }
    CHECK(compare_with_restarts<Dim>(options, MakeMemm{}, n_steps<Dim>, 23) > 0);
}

TEMPLATE_TEST_CASE_SIG("so do runs with a wall that moves and tractions that vary", "[solid][state]", ((int Dim), Dim), 2,
                       3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating);
    CAPTURE(static_cast<int>(kinematics));
    const std::vector<Kinematics> both{kinematics, kinematics};
    CHECK(compare_with_restarts<Dim>(driven<Dim>(both), MakeMemm{}, n_steps<Dim>, 23) > 0);
    CHECK(compare_with_restarts<Dim>(driven<Dim>(both), MakeLeapfrog{}, n_steps<Dim>, 37) > 0);
}

TEMPLATE_TEST_CASE_SIG("so do runs with dashpots and brakes", "[solid][state]", ((int Dim), Dim), 2, 3) {
    const std::vector<Kinematics> both{Kinematics::floating, Kinematics::floating};
    CHECK(compare_with_restarts<Dim>(tied<Dim>(both), MakeMemm{}, n_steps<Dim>, 23) > 0);
}

TEMPLATE_TEST_CASE_SIG("so do runs that another program drives", "[solid][state]", ((int Dim), Dim), 2, 3) {
    const auto kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::rigid);
    CAPTURE(static_cast<int>(kinematics));
    CHECK(compare_with_restarts<Dim>(pushed<Dim>({Kinematics::small, kinematics}), MakeMemm{}, n_steps<Dim>, 37) > 0);
}

TEMPLATE_TEST_CASE_SIG("so do runs under all schemes", "[solid][state]", ((int Dim), Dim), 2, 3) {
    const std::vector<Kinematics> both{Kinematics::small, Kinematics::small};
    CHECK(compare_with_restarts<Dim>(falling<Dim>(both), MakeLeapfrog{}, n_steps<Dim>, 23) > 0);
    CHECK(compare_with_restarts<Dim>(falling<Dim>(both), MakeBilbao{}, n_steps<Dim>, 23) > 0);
    CHECK(compare_with_restarts<Dim>(falling<Dim>(both), MakeAsync{}, 120, 11) > 0);
}

TEST_CASE("a saved state of other bodies, or a damaged one, is refused", "[solid][state][errors]") {
    const std::vector<Kinematics> both{Kinematics::small, Kinematics::small};
    const mesh::Mesh<2> mesh = stacked<2>(), other = two_discs(0.0, 0.5);
    solid::Solid<2> solid(mesh, falling<2>(both)), discs(other, bodies<2>(2));
    const std::vector<double> q(solid.size(), 0.0);
    const std::vector<std::byte> state = solid.state();
    CHECK_THROWS_WITH(discs.restore(state, std::vector<double>(discs.size(), 0.0)), Catch::Contains("another mesh"));
    auto damaged = state;
    damaged[damaged.size() / 2] ^= std::byte{1};
    CHECK_THROWS_WITH(solid.restore(damaged, q), Catch::Contains("checksum"));
    auto options = falling<2>(both);
    options.contact.reset();
    options.obstacles.clear();
    solid::Solid<2> without(mesh, options);
    CHECK_THROWS_WITH(without.restore(state, q), Catch::Contains("with contact"));
    CHECK_NOTHROW(solid.restore(state, q));
}
