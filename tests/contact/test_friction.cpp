#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/law/friction_step.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "contact/nodal_scenes.hpp"
#include "contact/surfaces.hpp"
#include "contact/turning.hpp"
#include "support/worst.hpp"

using namespace abut;
using namespace abut::test;
using contact::Along;
using contact::Friction;
using contact::FrictionStep;
using contact::StickState;

namespace {

template <int N>
Along<N> random_along(std::mt19937& random, double size) {
    Along<N> vector;
    for (int i = 0; i < N; ++i) vector[i] = uniform(random, -size, size);
    return vector;
}

/// As steps leave it: the stretch is 0, or along the direction.
template <int N>
StickState<N> random_state(std::mt19937& random) {
    StickState<N> state;
    state.stiffness = std::pow(10.0, uniform(random, -2.0, 6.0));
    state.direction = random_along<N>(random, 1.0);
    if (state.direction.norm() > 1.0) state.direction.normalize();
    if (uniform(random, 0.0, 1.0) < 0.8) state.stretch = uniform(random, 0.0, 2.0) * state.direction;
    return state;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("friction: work of the force is what the spring gains and what is lost, never less than nothing",
                       "[contact][friction]", ((int N), N), 1, 2) {
    std::mt19937 random(1);
    double balance = 0.0, gained = 0.0, above = 0.0;
    int slides = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        StickState<N> state = random_state<N>(random);
        const double k = state.stiffness, limit = k * uniform(random, 0.0, 2.0);
        const double creep = i % 3 == 0 ? std::pow(10.0, uniform(random, -4.0, 1.0)) : 0.0;
        const Along<N> motion = random_along<N>(random, std::pow(10.0, uniform(random, -3.0, 1.0)));
        const double before = state.energy();
        const FrictionStep<N> step = contact::take_mean_step<N>(state, motion, limit, creep);
        const double terms = before + state.energy() + step.force.norm() * motion.norm() + step.dissipated;
        raise(balance, std::abs(step.force.dot(motion) - (state.energy() - before) - step.dissipated) / terms);
        raise(gained, -step.dissipated / terms);
        if (limit > 0.0) raise(above, step.force.norm() / limit - 1.0);
        if (step.slides()) ++slides;
    }
    CHECK(slides > 100'000);
    CHECK(balance < 1e-14);
    CHECK(gained < 1e-15);
    CHECK(above < 1e-12);
}

/// A force that answered at once would feed the alternating mode of MEMM.
TEMPLATE_TEST_CASE_SIG("friction has no force against a slip that alternates from step to step", "[contact][friction]",
                       ((int N), N), 1, 2) {
    const double k = 1e6, largest = 0.3;  // limit / k
    const Along<N> motion = Along<N>::Unit(0) * 2.5 * largest;
    StickState<N> state{.stiffness = k};
    FrictionStep<N> step;
    for (int i = 0; i < 20; ++i)
        step = contact::take_mean_step<N>(state, i % 2 ? motion : Along<N>(-motion), k * largest, 0.0);
    CHECK(step.force.norm() <= 1e-12 * k * largest);

    // one that is shorter sticks: the force is constant, and nothing is lost
    state = {.stiffness = k};
    std::vector<double> force;
    for (int i = 0; i < 20; ++i) {
        const Along<N> shorter = motion * (i % 2 ? 0.2 : -0.2);
        step = contact::take_mean_step<N>(state, shorter, k * largest, 0.0);
        CHECK(step.dissipated == 0.0);
        force.push_back(step.force[0]);
    }
    CHECK(force.back() == Approx(force[force.size() - 2]));

    // where the limit alternates as well
    state = {.stiffness = k};
    double worst = 0.0;
    for (int i = 0; i < 60; ++i) {
        const double now = (i % 2 ? 0.5 : 1.5) * largest;
        step = contact::take_mean_step<N>(state, (i % 2 ? 50.0 : -50.0) * largest * Along<N>::Unit(0), k * now, 0.0);
        if (i > 20) raise(worst, step.force.norm() / (k * now));
    }
    CHECK(worst <= 0.02);
}

TEST_CASE("a face that slides steadily feels the limit, one that sticks a spring", "[contact][friction]") {
    StickState<2> state{.stiffness = 100.0};
    FrictionStep<2> step;
    for (int i = 0; i < 100; ++i) step = contact::take_mean_step<2>(state, Along<2>(0.01, 0.0), 3.0, 0.0);
    CHECK(step.force.isApprox(Along<2>(3.0, 0.0)));
    CHECK(step.dissipated == Approx(3.0 * 0.01));

    state = {.stiffness = 100.0};
    step = contact::take_mean_step<2>(state, Along<2>(0.0, 0.01), 3.0, 0.0);
    CHECK(step.force[1] == Approx(100.0 * 0.01 / 2));
    CHECK(step.dissipated == 0.0);
    CHECK_FALSE(step.slides());
}

/// A limit that rises within a step is no spring that has to be stretched first.
TEMPLATE_TEST_CASE_SIG("a face that slides on bears the limit of each step, whether that rises or falls",
                       "[contact][friction]", ((int N), N), 1, 2) {
    std::mt19937 random(2);
    const double k = 1e5, largest = 3e4;
    const Along<N> ahead = random_along<N>(random, 1.0).normalized(), motion = ahead * (largest / k);
    StickState<N> state{.stretch = 0.9 * motion, .direction = ahead, .stiffness = k};
    double before = state.energy();
    for (int i = 0; i < 1000; ++i) {
        const double limit = largest * uniform(random, 0.01, 0.99);
        const FrictionStep<N> step = contact::take_mean_step<N>(state, motion, limit, 0.0);
        const double expected = limit * limit / (2.0 * k);  // of the spring at its limit
        CHECK(step.slides());
        CHECK((step.force - limit * ahead).norm() <= 1e-12 * limit);
        CHECK(state.energy() == Approx(expected));
        CHECK(step.dissipated == Approx(limit * motion.norm() - (expected - before)).epsilon(1e-10));
        before = expected;
    }

    // one that turns round takes less from the motion than a rising limit would store: it stretches first
    state = {.stretch = -0.1 * motion, .direction = -ahead, .stiffness = k};
    before = state.energy();
    const FrictionStep<N> step = contact::take_mean_step<N>(state, motion, 0.5 * largest, 0.0);
    CHECK(step.slides());
    CHECK(step.force.norm() < 0.5 * largest);
    CHECK(step.dissipated >= -1e-15 * state.energy());
    CHECK(step.force.dot(motion) == Approx(state.energy() - before + step.dissipated));
}

TEMPLATE_TEST_CASE_SIG("a step without slip has the bits of the spring alone", "[contact][friction]", ((int N), N), 1, 2) {
    std::mt19937 random(3);
    int sticks = 0;
    for (int i = 0; i < 100'000; ++i) {
        StickState<N> state = random_state<N>(random);
        const double k = state.stiffness, limit = k * uniform(random, 0.0, 2.0);
        const Along<N> motion = random_along<N>(random, 0.5);
        const Along<N> start = contact::cut_to<N>(state.stretch, limit / k), end = start + motion;
        if (end.norm() >= limit / k) continue;
        const double cut_off = state.energy() - 0.5 * k * start.squaredNorm();
        const FrictionStep<N> step = contact::take_mean_step<N>(state, motion, limit, 0.0);
        ++sticks;
        CHECK(step.force == Along<N>(0.5 * k * (start + end)));
        CHECK(step.dissipated == cut_off);
        CHECK(state.stretch == end);
    }
    CHECK(sticks > 10'000);
}

TEST_CASE("a force that sticks relaxes by 1/e in the relaxation time", "[contact][friction]") {
    StickState<1> state{.stretch = Along<1>(0.02), .stiffness = 100.0};
    const int n = 1000;  // steps in one relaxation time
    double lost = 0.0;
    const double before = state.energy();
    for (int i = 0; i < n; ++i) lost += contact::take_mean_step<1>(state, Along<1>(0.0), 1e9, 0.5 / n).dissipated;
    CHECK(state.stretch[0] == Approx(0.02 * std::exp(-1.0)).epsilon(1e-6));
    CHECK(lost == Approx(before - state.energy()));
}

TEST_CASE("the coefficient of friction falls with speed, with slip, or as a host says", "[contact][friction]") {
    Friction law{.coefficient = 0.5, .sliding_coefficient = 0.2, .decay_speed = 2.0};
    CHECK(coefficient_of(law, {0.0, 0.0, 1.0}) == 0.5);
    CHECK(coefficient_of(law, {2.0, 7.0, 1.0}) == Approx(0.2 + 0.3 * std::exp(-1.0)));
    law = {.coefficient = 0.5, .sliding_coefficient = 0.2, .decay_slip = 0.1};
    CHECK(coefficient_of(law, {9.0, 0.025, 1.0}) == Approx(0.2 + 0.3 * 0.75));
    CHECK(coefficient_of(law, {9.0, 0.3, 1.0}) == 0.2);
    law = {.own_coefficient = [](const contact::Sliding& at) { return 0.1 / (1.0 + at.pressure); }};
    CHECK(coefficient_of(law, {0.0, 0.0, 1.0}) == 0.05);
    law.own_coefficient = [](const contact::Sliding&) { return -1.0; };
    CHECK_THROWS_AS(coefficient_of(law, {0.0, 0.0, 1.0}), BadInput);
}

TEST_CASE("laws of friction that cannot be are refused by name", "[contact][friction]") {
    using Catch::Matchers::Contains;
    const auto refused = [](const Friction& law, const std::string& name) {
        CHECK_THROWS_WITH(check(contact::FrictionOptions{.laws = {law}}), Contains(name));
    };
    refused({.coefficient = -0.1}, "friction is -0.1; 0 or above is needed");
    refused({.coefficient = std::nan("")}, "friction is nan");
    refused({.coefficient = 0.5, .sliding_coefficient = 0.2}, "decay_speed");
    refused({.coefficient = 0.5, .decay_speed = 0.0}, "decay_speed is 0");
    refused({.strength = -1.0}, "strength");
    refused({.coefficient = 0.5, .relaxation_time = 0.0}, "relaxation_time");
    CHECK_NOTHROW(check(contact::FrictionOptions{.laws = {{.coefficient = 0.5}}}));
}

// Contact on nodes ---------------------------------------------------------------------------------------------------

namespace {

/// Two boxes that are pressed into each other, with the shear stiffness that friction needs.
template <int Dim>
struct Rubbing {
    explicit Rubbing(const Friction& law, bool with_shear = true, bool cut = true)
        : scene(two_boxes<Dim>(3, 4, -0.01, 0.013, 3.0, 5.0, cut)) {
        shear.assign(scene.faces.stiffness.size(), 0.0);
        for (std::size_t body = 0; body < shear.size(); ++body) shear[body] = 0.3 * scene.faces.stiffness[body];
        has_shear = with_shear;
        contact::NodalOptions options;
        options.search.largest_motion = 10.0;
        if (law.acts()) options.friction.laws = {law};
        contact.emplace(surface(), options);
    }
    [[nodiscard]] contact::NodalSurface<Dim> surface() const {
        contact::NodalFaces<Dim> faces = scene.faces.view();
        if (has_shear) faces.shear_stiffness = shear;
        return {scene.rest, faces};
    }
    [[nodiscard]] std::vector<Vector<Dim>> upper_moved(const Vector<Dim>& by) const {
        std::vector<Vector<Dim>> x = scene.rest;
        for (std::size_t n = 0; n < x.size(); ++n)
            if (scene.node_body[n] == 1) x[n] += by;
        return x;
    }

    NodalScene<Dim> scene;
    std::vector<double> shear;
    bool has_shear = true;
    std::optional<contact::NodalContact<Dim>> contact;
};

template <int Dim>
std::vector<Vector<Dim>> noisy(std::mt19937& random, std::vector<Vector<Dim>> x, double size) {
    for (Vector<Dim>& point : x) point += random_vector<Dim>(random, size);
    return x;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("with friction forces have no sum and no moment about the middle, and their work is booked",
                       "[contact][friction][nodal]", ((int Dim), Dim), 2, 3) {
    std::mt19937 random(3);
    Rubbing<Dim> rubbing({.coefficient = 0.05});
    auto x_0 = rubbing.scene.rest;
    double energy_0 = rubbing.contact->evaluate(x_0).energy, balance = 0.0, momentum = 0.0, moments = 0.0, least = 0.0;
    std::int64_t slides = 0, sticks = 0;
    for (int i = 0; i < 200; ++i) {
        Vector<Dim> drift = Vector<Dim>::Zero();
        drift[0] = i % 40 < 20 ? 3e-4 : -3e-4;
        auto x_1 = noisy<Dim>(random, x_0, 5e-5);
        for (std::size_t n = 0; n < x_1.size(); ++n)
            if (rubbing.scene.node_body[n] == 1) x_1[n] += drift;
        const contact::NodalStep<Dim>& step = rubbing.contact->step(1e-3, x_0, x_1);
        double work = 0.0, forces = 0.0;
        Vector<Dim> sum = Vector<Dim>::Zero();
        AxialVector<Dim> moment = AxialVector<Dim>::Zero();
        for (std::size_t n = 0; n < step.nodes.size(); ++n) {
            const std::int32_t node = step.nodes[n];
            work += step.gradient[n].dot(x_1[node] - x_0[node]);
            forces += step.gradient[n].norm();
            sum += step.gradient[n];
            moment += abut::moment<Dim>(Vector<Dim>(0.5 * (x_0[node] + x_1[node])), step.gradient[n]);
        }
        const contact::FrictionFigures& friction = step.report.friction;
        const double energy = step.energy + friction.energy;
        raise(balance, std::abs(work - (energy - energy_0) - friction.dissipated) / (energy + energy_0));
        raise(momentum, sum.norm() / forces);
        raise(moments, moment.norm() / forces);
        raise(least, -friction.least_dissipated / energy);
        CHECK(friction.largest_ratio <= 1.0 + 1e-12);
        slides += friction.sliding;
        sticks += friction.sticking;
        energy_0 = energy;
        x_0 = x_1;
    }
    CHECK(slides > 200);
    CHECK(sticks > 200);
    CHECK(balance < 1e-12);
    CHECK(momentum < 1e-14);
    CHECK(moments < 1e-14);
    CHECK(least < 1e-15);
}

TEMPLATE_TEST_CASE_SIG("bodies that turn together do not rub, by any angle", "[contact][friction][nodal]", ((int Dim), Dim),
                       2, 3) {
    std::mt19937 random(4);
    Rubbing<Dim> rubbing({.coefficient = 0.4});
    const auto x_0 = rubbing.scene.rest;
    for (int i = 0; i < 20; ++i) {
        const Matrix<Dim> map = turn<Dim>(random, 1.5);
        auto x_1 = x_0;
        for (Vector<Dim>& point : x_1) point = map * point;
        const auto& step = rubbing.contact->step(1e-3, x_0, x_1);
        double slip = 0.0;
        for (const auto& pair : step.pairs) raise(slip, pair.slip.norm());
        CHECK(step.report.friction.energy <= 1e-24);
        CHECK(slip <= 1e-13);
        CHECK(!step.pairs.empty());
    }
}

TEMPLATE_TEST_CASE_SIG("a law of friction that never acts gives the bits of no friction", "[contact][friction][nodal]",
                       ((int Dim), Dim), 2, 3) {
    std::mt19937 random(5);
    Rubbing<Dim> without({}, false), with({.coefficient = 0.4});
    auto x_0 = without.scene.rest;
    for (int i = 0; i < 20; ++i) {
        auto x_1 = noisy<Dim>(random, x_0, 1e-4);
        const auto& a = without.contact->step(1e-3, x_0, x_1);
        const auto& b = with.contact->step(1e-3, x_0, x_1);
        REQUIRE(a.pairs.size() == b.pairs.size());
        CHECK(a.energy == b.energy);
        for (std::size_t p = 0; p < a.pairs.size(); ++p) {
            CHECK(a.pairs[p].normal_force == b.pairs[p].normal_force);
            CHECK((a.pairs[p].force + b.pairs[p].friction).isApprox(b.pairs[p].force, 1e-13));
        }
        x_0 = x_1;
    }
    contact::NodalOptions options;
    options.friction.laws = {{.coefficient = 0.4}};
    options.friction.law_of = [](contact::Face, contact::Face) { return -1; };
    const auto surface = two_boxes<Dim>(3, 4, -0.01);
    contact::NodalFaces<Dim> faces = surface.faces.view();
    std::vector<double> shear(surface.faces.stiffness.size(), 1.0);
    faces.shear_stiffness = shear;
    contact::NodalContact<Dim> none(contact::NodalSurface<Dim>(surface.rest, faces), options);
    Rubbing<Dim> plain({}, false);
    const auto x_1 = noisy<Dim>(random, surface.rest, 1e-3);
    CHECK(none.step(1e-3, surface.rest, x_1).gradient == plain.contact->step(1e-3, surface.rest, x_1).gradient);
}

TEST_CASE("friction without the shear stiffness of faces is refused", "[contact][friction][nodal]") {
    CHECK_THROWS_WITH(Rubbing<2>({.coefficient = 0.4}, false), Catch::Matchers::Contains("shear_stiffness"));
}

TEMPLATE_TEST_CASE_SIG("friction goes on after a restore with the same bits", "[contact][friction][nodal]", ((int Dim), Dim),
                       2, 3) {
    std::mt19937 random(6);
    Rubbing<Dim> first({.coefficient = 0.01}), second({.coefficient = 0.01});
    const auto force_of = [&](const contact::NodalStep<Dim>& step) {
        std::vector<Vector<Dim>> force(first.scene.rest.size(), Vector<Dim>::Zero());
        step.add_force_to(force);
        return force;
    };
    auto x_0 = first.scene.rest;
    for (int i = 0; i < 30; ++i) {
        auto x_1 = noisy<Dim>(random, x_0, 1e-4);
        first.contact->step(1e-3, x_0, x_1);
        if (i >= 15) {
            const auto expected = force_of(first.contact->last());
            CHECK((force_of(second.contact->step(1e-3, x_0, x_1)) == expected));
        }
        if (i == 14) second.contact->restore(first.contact->state());
        x_0 = x_1;
    }
    CHECK(first.contact->report().friction_dissipated > 0.0);
    CHECK(first.contact->report().friction_dissipated == second.contact->report().friction_dissipated);
}

TEST_CASE("the friction of each pair is told where a state is evaluated, with faces of four corners as well",
          "[contact][friction][nodal]") {
    for (const bool cut : {true, false}) {
        Rubbing<3> rubbing({.coefficient = 0.4}, true, cut);
        const auto x_1 = rubbing.upper_moved({1e-3, 2e-3, 0.0});
        rubbing.contact->step(1e-3, rubbing.scene.rest, x_1);
        const auto& state = rubbing.contact->evaluate(x_1);
        REQUIRE(!state.pairs.empty());
        Vector<3> sum = Vector<3>::Zero(), normal_forces = Vector<3>::Zero();
        for (const auto& pair : state.pairs) {
            CHECK(pair.friction.norm() > 0.0);
            CHECK(std::abs(pair.friction.dot(pair.normal)) <= 1e-12 * pair.friction.norm());
            sum += pair.friction;
            normal_forces += pair.force - pair.friction;
        }
        // the springs of a uniform slip are stretched by it: K/k of the pairs is the same everywhere
        CHECK(sum[0] / sum[1] == Approx(0.5));
        CHECK((sum + normal_forces).isApprox(state.body_pairs.front().force, 1e-12));
    }
}

TEST_CASE("a step that is refused dissipates nothing", "[contact][friction][nodal]") {
    Rubbing<2> rubbing({.coefficient = 0.01});
    const auto x_1 = rubbing.upper_moved({5e-3, 0.0});
    rubbing.contact->step(1e-3, rubbing.scene.rest, x_1);
    const double dissipated = rubbing.contact->report().friction_dissipated;
    CHECK(dissipated > 0.0);
    CHECK_THROWS_AS(rubbing.contact->step(1e-3, x_1, rubbing.upper_moved({0.1, -0.5})), TooDeep);
    CHECK(rubbing.contact->report().friction_dissipated == dissipated);
}

TEST_CASE("what faces hold is dissipated where they go", "[contact][friction][nodal]") {
    Rubbing<2> rubbing({.coefficient = 0.4});
    const double held =
        rubbing.contact->step(1e-3, rubbing.scene.rest, rubbing.upper_moved({1e-3, 0.0})).report.friction.energy;
    CHECK(held > 0.0);
    const double before = rubbing.contact->report().friction_dissipated;
    const std::vector<std::int32_t> all_new(static_cast<std::size_t>(rubbing.contact->surface().n_faces()), -1);
    rubbing.contact->surface_replaced(rubbing.surface(), all_new);
    CHECK(rubbing.contact->report().friction_dissipated - before == Approx(held));
}

TEST_CASE("a law that is not there is refused", "[contact][friction]") {
    contact::FrictionOptions options{.laws = {{.coefficient = 0.4}}};
    options.law_of = [](contact::Face, contact::Face) { return 1; };
    CHECK_THROWS_WITH(static_cast<void>(options.law_between(contact::Face{3}, contact::Face{5})),
                      Catch::Matchers::Contains("faces 3 and 5 are given law 1 of 1"));
}
