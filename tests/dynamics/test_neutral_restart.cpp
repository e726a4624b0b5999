// The neutral restart takes any system of points that says which of them make up a body.
#include "abut/dynamics/neutral_restart.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/particles.hpp"
#include "dynamics/row.hpp"

using namespace abut;
using dynamics::MomentArms;
using test::Conserved;
using test::NodeState;
using test::Row;
using test::square_of_e;

namespace {

const std::vector<double> row_masses{1.0, 2.0, 0.5, 1.5, 0.7, 1.1, 0.9, 1.3, 0.6};
const std::vector<std::int32_t> first{0, 2, 3, 7, 8}, second{1, 4, 5, 6};  // the points of two bodies

template <int Dim>
Row<Dim> two_bodies(MomentArms arms) {
    Row<Dim> row(row_masses, 3.0);
    row.arms = arms;
    row.bodies = {0, 1, 0, 0, 1, 1, 1, 0, 0};
    return row;
}

/// Random q and p, and an e of some size beside what the force of the step does.
template <int Dim>
NodeState state_with_e(std::mt19937& random, Row<Dim>& row, double dt, double e) {
    NodeState state = test::random_state(random, row.size(), dt);
    const std::vector<double> noise = test::random_values(random, row.size());
    std::vector<double> force(row.size());
    row.force(state.q, force);
    for (std::size_t j = 0; j < row.size(); ++j) state.after[j] = state.before[j] + dt * force[j] + e * noise[j];
    return state;
}

template <int Dim>
NodeState restarted(Row<Dim>& row, NodeState state, dynamics::RestartReport& report) {
    dynamics::NeutralRestart restart(row, {.period = 1});
    restart(state.q, state.dt, state.before, state.after);
    report = restart.report();
    return state;
}

/// 1/2 p . M^-1 p with the p of the node.
template <int Dim>
double kinetic(const Row<Dim>& row, const NodeState& state) {
    double sum = 0.0;
    for (std::size_t j = 0; j < row.size(); ++j) {
        const double p = 0.5 * (state.before[j] + state.after[j]);
        sum += 0.5 * row.inverse_mass()[j] * p * p;
    }
    return sum;
}

/// A hexagon of strings around a point that turns: masses, positions and bonds of a body of the plane that is geometrically
/// exact, so that J~ is what MEMM conserves.
class Net : public dynamics::Particles<dynamics::StringSegment> {
public:
    static constexpr int dimension = 2;
    Net() : Particles(std::vector<double>(14, 1.0 / mass), bonds()), rest_(corners()) {}
    [[nodiscard]] std::span<const Vector<2>> rest_positions() const { return rest_; }
    [[nodiscard]] std::span<const double> masses() const { return masses_; }
    [[nodiscard]] MomentArms moment_arms() const { return MomentArms::mid_step; }
    [[nodiscard]] std::span<const std::int32_t> body_of_points() const { return bodies_; }

    /// Momenta of a rotation about the middle, and of a flight.
    [[nodiscard]] std::vector<double> spinning(double omega, const Vector<2>& velocity) const {
        std::vector<double> p(size());
        for (std::size_t i = 0; i < rest_.size(); ++i) {
            p[2 * i] = mass * (velocity.x() - omega * rest_[i].y());
            p[2 * i + 1] = mass * (velocity.y() + omega * rest_[i].x());
        }
        return p;
    }

private:
    static constexpr double mass = 0.5;
    static std::vector<Vector<2>> corners() {
        std::vector<Vector<2>> positions{Vector<2>::Zero()};
        for (int i = 0; i < 6; ++i)
            positions.emplace_back(std::cos(i * std::numbers::pi / 3.0), std::sin(i * std::numbers::pi / 3.0));
        return positions;
    }
    static std::vector<dynamics::Bond<dynamics::StringSegment>> bonds() {
        std::vector<dynamics::Bond<dynamics::StringSegment>> bonds;
        const auto positions = corners();
        const auto join = [&](int a, int b) {
            bonds.push_back({a, b, {.stiffness = 40.0, .length = 1.0}, positions[b] - positions[a]});
        };
        for (int i = 1; i <= 6; ++i) join(0, i);
        for (int i = 1; i <= 6; ++i) join(i, i % 6 + 1);
        return bonds;
    }
    std::vector<Vector<2>> rest_;
    std::vector<double> masses_ = std::vector<double>(7, mass);
    std::vector<std::int32_t> bodies_ = std::vector<std::int32_t>(7, 0);
};

/// The restart with the rigid motion about the positions at the node, theta = 1: keeps sum x × p.
NodeState restarted_about_the_node(Net& net, NodeState state) {
    const std::size_t n = net.masses().size();
    std::vector<double> force(net.size());
    net.force(state.q, force);
    const auto f_i = as_vectors<2>(std::span<const double>(force)), q = as_vectors<2>(std::span<const double>(state.q));
    const auto before = as_vectors<2>(std::span(state.before)), after = as_vectors<2>(std::span(state.after));
    const double m = net.masses()[0];
    Vector<2> centre = Vector<2>::Zero(), momentum = Vector<2>::Zero();
    std::vector<Vector<2>> x(n), p(n), f(n), e(n);
    for (std::size_t i = 0; i < n; ++i) {
        x[i] = net.rest_positions()[i] + q[i];
        p[i] = 0.5 * (before[i] + after[i]);
        f[i] = state.dt * f_i[i];
        e[i] = after[i] - before[i] - f[i];
        centre += x[i] / static_cast<double>(n);
        momentum += p[i];
    }
    double spin = 0.0, inertia = 0.0, vibration = 0.0, a = 0.0, b = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        spin += test::moment<2>(Vector<2>(x[i] - centre), p[i])[0];
        inertia += m * (x[i] - centre).squaredNorm();
    }
    std::vector<Vector<2>> r(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vector<2> arm = x[i] - centre;
        r[i] = momentum / static_cast<double>(n) + m * spin / inertia * Vector<2>(-arm.y(), arm.x());
        vibration += 0.5 * (p[i] - r[i]).squaredNorm() / m;
        a += f[i].dot(e[i]) / m;
        b += e[i].squaredNorm() / m;
    }
    const double sigma = std::sqrt(1.0 - ((a + b) / 4.0 - b / 8.0) / vibration);
    for (std::size_t i = 0; i < n; ++i) {
        const Vector<2> mean = r[i] + sigma * (p[i] - r[i]);
        before[i] = mean - 0.5 * f[i];
        after[i] = mean + 0.5 * f[i];
    }
    return state;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG(
    "a restart changes neither H~ nor momentum nor the conserved angular momentum of any body, and takes e away",
    "[dynamics][restart]", ((int Dim), Dim), 1, 2, 3) {
    std::mt19937 random(3);
    const MomentArms arms = GENERATE(MomentArms::rest, MomentArms::mid_step);
    Row<Dim> row = two_bodies<Dim>(arms);
    for (int trial = 0; trial < 20; ++trial) {
        const NodeState given = state_with_e(random, row, 0.3, 0.1);
        dynamics::RestartReport report;
        const NodeState after = restarted(row, given, report);
        REQUIRE(report.shortened + report.skipped == 0);
        CHECK(square_of_e(row, given) > 1e-3);
        CHECK(square_of_e(row, after) < 1e-28);
        for (const auto& body : {first, second}) {
            const Conserved<Dim> a(row, given, body), b(row, after, body);
            CHECK(std::abs(b.kinetic - a.kinetic) < 1e-14);
            CHECK((b.momentum - a.momentum).norm() < 1e-14);
            if (arms == MomentArms::rest) CHECK((b.rest - a.rest).norm() < 5e-14);
            if (arms == MomentArms::mid_step) CHECK((b.pseudo - a.pseudo).norm() < 5e-14);
        }
    }
}

TEMPLATE_TEST_CASE_SIG("what a restart takes out of H, the vibration pays", "[dynamics][restart]", ((int Dim), Dim), 1, 2,
                       3) {
    std::mt19937 random(4);
    Row<Dim> row = two_bodies<Dim>(MomentArms::rest);
    const NodeState given = state_with_e(random, row, 0.3, 0.1);
    dynamics::RestartReport report;
    const NodeState after = restarted(row, given, report);
    CHECK(std::abs(report.paid) > 1e-4);
    CHECK(kinetic(row, given) - kinetic(row, after) == Approx(report.paid).epsilon(1e-11));
}

TEMPLATE_TEST_CASE_SIG("a restart that the vibration cannot pay whole takes a part of e, as neutral, and is counted",
                       "[dynamics][restart]", ((int Dim), Dim), 1, 2, 3) {
    std::mt19937 random(5);
    const MomentArms arms = GENERATE(MomentArms::rest, MomentArms::mid_step);
    Row<Dim> row = two_bodies<Dim>(arms);
    std::int64_t shortened = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const NodeState given = state_with_e(random, row, 0.1, 3.0);
        dynamics::RestartReport report;
        const NodeState after = restarted(row, given, report);
        shortened += report.shortened;
        CHECK(report.skipped == 0);
        for (const auto& body : {first, second}) {
            const Conserved<Dim> a(row, given, body), b(row, after, body);
            CHECK(std::abs(b.kinetic - a.kinetic) < 3e-14);
            CHECK((b.momentum - a.momentum).norm() < 3e-14);
            if (arms == MomentArms::rest) CHECK((b.rest - a.rest).norm() < 1e-13);
            if (arms == MomentArms::mid_step) CHECK((b.pseudo - a.pseudo).norm() < 1e-13);
        }
        // Of each e a power of two stays.
        const double left = std::sqrt(square_of_e(row, after) / square_of_e(row, given));
        CHECK(left < 1.0);
        if (report.shortened == 0) CHECK(left < 1e-14);
    }
    CHECK(shortened > 0);
}

TEST_CASE("a restart leaves bodies alone in which nothing vibrates, and counts them", "[dynamics][restart]") {
    Row<2> row({1.0, 2.0, 0.5}, 0.0);
    row.bodies = {0, 1, 1};
    std::mt19937 random(6);
    NodeState given = test::random_state(random, row.size(), 0.1);
    for (const std::size_t j : {2, 3}) {  // the second body flies, but its e is not rigid
        given.before[j] = 2.0 * (j == 2 ? 0.3 : -0.2) - 0.1;
        given.after[j] = 2.0 * (j == 2 ? 0.3 : -0.2) + 0.1;
        given.before[j + 2] = 0.5 * (j == 2 ? 0.3 : -0.2) + 0.1;
        given.after[j + 2] = 0.5 * (j == 2 ? 0.3 : -0.2) - 0.1;
    }
    dynamics::RestartReport report;
    const NodeState after = restarted(row, given, report);
    CHECK(report.restarts == 1);
    CHECK(report.skipped == 2);
    CHECK(report.paid == 0.0);
    CHECK(after.before == given.before);
    CHECK(after.after == given.after);
}

TEST_CASE("an e that is nothing but rounding is left alone, and not counted", "[dynamics][restart]") {
    std::mt19937 random(8);
    Row<3> row = two_bodies<3>(MomentArms::mid_step);
    const NodeState given = state_with_e(random, row, 0.1, 1e-17);
    dynamics::RestartReport report;
    const NodeState after = restarted(row, given, report);
    CHECK(report.skipped == 0);
    CHECK(after.after == given.after);
}

TEST_CASE("a body on a line in space, which cannot carry a moment about it, keeps J~ and is counted",
          "[dynamics][restart]") {
    std::mt19937 random(9);
    Row<3> row({1.0, 2.0}, 3.0);
    row.arms = MomentArms::mid_step;
    row.bodies = {0, 0};
    const NodeState given = state_with_e(random, row, 0.3, 0.01);
    dynamics::RestartReport report;
    const NodeState after = restarted(row, given, report);
    const Conserved<3> a(row, given, std::vector<std::int32_t>{0, 1}), b(row, after, std::vector<std::int32_t>{0, 1});
    CHECK((b.pseudo - a.pseudo).norm() < 1e-14);
    CHECK(report.skipped == 1);
}

TEST_CASE("a body that spins through many turns keeps H~, momentum and J~ through restarts; about the node J~ moves",
          "[dynamics][restart]") {
    Net net;
    const double omega = 0.8, dt = 0.02;
    std::mt19937 random(21);
    std::vector<double> at_start = test::random_values(random, net.size());
    for (double& value : at_start) value *= 0.05;  // it vibrates
    dynamics::Memm memm(net, at_start, net.spinning(omega, {0.3, -0.1}), dt);
    dynamics::NeutralRestart restart(net, {.period = 50});
    const std::vector<std::int32_t> all{0, 1, 2, 3, 4, 5, 6};
    double kinetic = 0.0, momentum = 0.0, spin = 0.0, about_node = 0.0;
    memm.set_after_step([&](auto, double, auto, auto p_after) {  // what contact events would do
        if (memm.steps() % 50 != 10) return;
        for (double& p : p_after) p += 0.002 * std::uniform_real_distribution<double>(-1.0, 1.0)(random);
    });
    memm.set_node_restart([&](auto q, double step, auto p_before, auto p_after) {
        const auto state = [&] {
            return NodeState{
                {q.begin(), q.end()}, {p_before.begin(), p_before.end()}, {p_after.begin(), p_after.end()}, step};
        };
        const NodeState given = state();
        const Conserved<2> before(net, given, all);
        restart(q, step, p_before, p_after);
        const Conserved<2> after(net, state(), all);
        kinetic = std::max(kinetic, std::abs(after.kinetic - before.kinetic));
        momentum = std::max(momentum, (after.momentum - before.momentum).norm());
        spin = std::max(spin, (after.pseudo - before.pseudo).norm());
        if (memm.steps() % 50 != 0) return;
        const Conserved<2> other(net, restarted_about_the_node(net, given), all);
        CHECK((other.moved - before.moved).norm() < 1e-13);
        CHECK(std::abs(other.kinetic - before.kinetic) < 1e-13);
        about_node = std::max(about_node, (other.pseudo - before.pseudo).norm());
    });
    double drift = 0.0, energy_drift = 0.0, after_restart = 0.0, at_kick = 0.0, energy_at_kick = 0.0;
    std::vector<double> e(net.size());
    const auto j = [&] { return dynamics::pseudo_angular_momentum<2>(memm, dt, net.rest_positions(), net.masses())[0]; };
    while (memm.time() * omega < 20.0 * std::numbers::pi) {
        memm.step();
        const std::int64_t since_kick = (memm.steps() + 40) % 50;
        if (since_kick == 0) {
            at_kick = j();
            energy_at_kick = memm.pseudo_energy();
        }
        if (since_kick == 40) {  // just restarted
            memm.parasitic_momentum(e);
            for (const double part : e) after_restart = std::max(after_restart, std::abs(part));
        }
        if (since_kick == 49 && memm.steps() > 50) {
            drift = std::max(drift, std::abs(j() - at_kick));
            energy_drift = std::max(energy_drift, std::abs(memm.pseudo_energy() - energy_at_kick));
        }
    }
    CHECK(restart.report().restarts > 70);
    CHECK(restart.report().shortened + restart.report().skipped == 0);
    CHECK(std::abs(restart.report().paid) > 1e-6);
    CHECK(kinetic < 1e-14);
    CHECK(momentum < 1e-14);
    CHECK(spin < 1e-13);
    CHECK(drift < 1e-13);
    CHECK(energy_drift < 1e-13);
    CHECK(about_node > 1e-9);
    CHECK(after_restart < 1e-14);
}

TEST_CASE("restarts come every so many steps, and a saved run goes on counting", "[dynamics][restart]") {
    std::mt19937 random(10);
    Row<2> row = two_bodies<2>(MomentArms::rest);
    const NodeState given = state_with_e(random, row, 0.3, 0.1);
    dynamics::NeutralRestart restart(row, {.period = 4, .steps_before = 6});
    for (int step = 7; step <= 12; ++step) {
        NodeState state = given;
        restart(state.q, state.dt, state.before, state.after);
        CHECK((state.after != given.after) == (step % 4 == 0));
    }
    CHECK(restart.report().restarts == 2);
}

TEST_CASE("a restart refuses periods below 1, steps below 0 and points without a body", "[dynamics][restart][errors]") {
    Row<2> row = two_bodies<2>(MomentArms::rest);
    const auto make = [&](dynamics::RestartOptions options) { dynamics::NeutralRestart(row, options); };
    CHECK_THROWS_WITH(make({.period = 0}), Catch::Matchers::Contains("every 0 steps; give 1 or more"));
    CHECK_THROWS_WITH(make({.steps_before = -1}), Catch::Matchers::Contains("-1 steps were taken before"));
    row.bodies[3] = -1;
    CHECK_THROWS_WITH(make({}), Catch::Matchers::Contains("-1"));
    row.bodies.pop_back();
    CHECK_THROWS_WITH(make({}), Catch::Matchers::Contains("8 points have a body"));
}
