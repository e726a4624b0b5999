// Friction of bodies that slide, of impulses that are made up.
#include "abut/run/watch/friction_watch.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "run/scenes.hpp"

namespace {

using namespace abut;

constexpr double mu = 0.3, normal_force = 2.0, dt = 0.01;

/// A block on a plane, whose impulses grow record by record.
class Sliding {
public:
    Sliding() : scene_(test::block_on_plane(1.0)), options_{.friction = {.coefficient = mu}}, watch_(scene_, options_) {
        record();
    }

    /// The block slides by `slip` [m] in `dt` under `friction` [N]; springs hold `energy` [J].
    void step(const Vector<2>& slip, const Vector<2>& friction, double energy = 0.0) {
        impulse_.friction += dt * friction;
        impulse_.rubbing_impulse += dt * normal_force;
        impulse_.slip += normal_force * slip;
        entry_.time += dt;
        entry_.losses.by_friction += std::abs(friction.dot(slip));
        entry_.friction_energy = energy;
        record();
    }
    [[nodiscard]] run::WeakFriction weakest() const { return watch_.weakest(); }

private:
    void record() { watch_.record(entry_, std::vector{impulse_}, 1.0); }

    run::Scene<2> scene_;
    run::RunOptions options_;
    run::FrictionWatch<2> watch_;
    solid::BodyImpulse<2> impulse_{0, 1, Vector<2>::Zero(), 0.0};
    dynamics::LedgerEntry<2> entry_{};
};

Vector<2> towards(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// The weak friction of a block on a table that turns by `angle` [rad] in each record, with so much of its friction.
run::WeakFriction on_a_table(double angle, double share) {
    Sliding block;
    for (int i = 0; i < 200; ++i) block.step(dt * towards(i * angle), -share * mu * normal_force * towards(i * angle));
    return block.weakest();
}

}  // namespace

TEST_CASE("friction that turns with the slip has its whole size, whatever the angle within a part", "[run][friction]") {
    for (const double angle : {0.0, 0.01, 0.05, 0.1}) CHECK(on_a_table(angle, 1.0).seconds == 0.0);
}

TEST_CASE("friction at 0.6 of its limit is told of as that, less what turns within five records", "[run][friction]") {
    for (const double angle : {0.0, 0.05, 0.1}) {
        const run::WeakFriction weak = on_a_table(angle, 0.6);
        const double chord = angle > 0.0 ? std::sin(2.5 * angle) / (5.0 * std::sin(0.5 * angle)) : 1.0;  // of five steps
        CHECK(weak.share == Approx(0.6 * chord).epsilon(1e-12));
        CHECK(weak.seconds == Approx(200 * dt));  // eight parts
        CHECK(weak.body_2 == "obstacle 'obstacle_0'");
    }
}

TEST_CASE("a slip that turns back and has not stretched the springs the other way is not weak friction", "[run][friction]") {
    // A spring of stiffness k bears mu N at the stretch u; to turn it over takes 2 u, and 200 records here.
    const double limit = mu * normal_force, u = 100.0 * dt, stiffness = limit / u;
    for (const bool goes_on : {false, true}) {
        Sliding block;
        double stretch = 0.0;
        const auto slide = [&](double slip, double share) {
            stretch = std::clamp(stretch + slip, -share * u, share * u);
            block.step({slip, 0.0}, {-stiffness * stretch, 0.0}, 0.5 * stiffness * stretch * stretch);
        };
        for (int i = 0; i < 300; ++i) slide(dt, 1.0);
        for (int i = 0; i < 200; ++i) slide(-dt, 1.0);
        CHECK(block.weakest().seconds == 0.0);
        for (int i = 0; i < 600; ++i) slide(-dt, goes_on ? 0.5 : 1.0);  // friction is back, or half of it is
        CHECK((block.weakest().seconds > 0.0) == goes_on);
        if (goes_on) CHECK(block.weakest().share == Approx(0.5));
    }
}
