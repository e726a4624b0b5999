#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/solid/contact_view.hpp"

using namespace abut;
using solid::Kinematics;

namespace {

constexpr double g = 10.0, width = 0.8, height = 0.4;

/// A block on a plane without end; gravity leans by `degrees`.
run::Scene<2> block(Kinematics kinematics, double degrees) {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {width, height}, {8, 4}, mesh::CellShape::quadrangle, "block");
    scene.solid.materials = {{.young = 1e7, .poisson = 0.3, .density = 1000.0}};
    scene.solid.kinematics = {kinematics};
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 10.0)};
    const double angle = degrees * M_PI / 180.0;
    scene.solid.acceleration = {g * Vector<2>(std::sin(angle), -std::cos(angle))};
    scene.velocity = {Vector<2>::Zero()};
    return scene;
}

/// On a plane that it does not leave as it slides.
run::Scene<2> sliding_block(Kinematics kinematics, double degrees) {
    run::Scene<2> scene = block(kinematics, degrees);
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 1e4)};
    return scene;
}

run::RunOptions settling(double friction) {
    run::RunOptions options;
    options.settle = true;
    options.steps = 2000;
    options.interval = 1;
    options.friction.coefficient = friction;
    return options;
}

/// Looks at the first and the last state, and at what pushes the plane.
struct Look final : run::Observer<2> {
    bool wants_look(std::int64_t step) const override { return step == 0 || step == 2000; }
    void look(const dynamics::RunView<2>& run, solid::Solid<2>& solid) override {
        (run.steps == 0 ? first : last).assign(run.q.begin(), run.q.end());
        rest.assign(solid.rest_positions().begin(), solid.rest_positions().end());
        if (run.steps > 0 && !solid.options().obstacles.empty()) push = solid.contact().obstacle_force(0);
    }

    std::vector<double> first, last;
    std::vector<Vector<2>> rest;
    Vector<2> push;
};

/// Is told how bodies come to rest, and ends it after a while.
struct Watch final : run::Observer<2> {
    void settling(std::int64_t step, double speed) override {
        steps.push_back(step);
        speeds.push_back(speed);
    }
    [[nodiscard]] bool asks_to_stop() const override { return steps.size() >= most; }
    bool wants_look(std::int64_t) const override { return false; }
    std::vector<std::int64_t> steps;
    std::vector<double> speeds;
    std::size_t most = 1000000;
};

double largest_kinetic(const run::RunResult<2>& result) {
    double largest = 0.0;
    for (const auto& entry : result.ledger.entries()) largest = std::max(largest, entry.kinetic);
    return largest;
}

}  // namespace

TEST_CASE("a block that was brought to rest stands still, with its whole weight on the plane", "[run][settling]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    const run::Scene<2> scene = block(kinematics, 0.0);
    Look look;
    const run::RunResult<2> result = run::simulate<2>(scene, settling(0.0), look);
    REQUIRE(result.run.settling);
    CHECK(result.run.settling->rests > 1);
    const double weight = 1000.0 * width * height * g;
    CHECK(look.push[1] == Approx(-weight).epsilon(1e-9));
    CHECK(std::abs(look.push[0]) < 1e-9 * weight);
    CHECK(largest_kinetic(result) < 1e-18 * weight * height);
    double drift = 0.0;
    for (std::size_t i = 0; i < look.first.size(); ++i) drift = std::max(drift, std::abs(look.last[i] - look.first[i]));
    CHECK(drift < 1e-12);
    // Where nothing turns or opens, all is linear up to strains of 1e-4: V, the work of the weight taken off, is half of that work
    // (Clapeyron).
    double sunk = 0.0;
    for (std::size_t i = 1; i < look.first.size(); i += 2)
        sunk -= look.first[i] / (0.5 * static_cast<double>(look.first.size()));
    CHECK(sunk > 0.0);
    if (kinematics == Kinematics::small)
        CHECK(result.ledger.entries().front().potential == Approx(-0.5 * weight * sunk).epsilon(1e-4));
}

TEST_CASE("a block on 10 degrees sticks from the start: no face slides, friction takes nothing",
          "[run][settling][friction]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid);
    const solid::ContactLaw law = GENERATE(solid::ContactLaw::pair_potential, solid::ContactLaw::reconstruction);
    if (law == solid::ContactLaw::reconstruction && kinematics != Kinematics::small) return;
    const run::Scene<2> scene = block(kinematics, 10.0);
    run::RunOptions options = settling(0.3);
    options.law = law;
    Look look;
    const run::RunResult<2> result = run::simulate<2>(scene, options, look);
    const double weight = 1000.0 * width * height * g, angle = 10.0 * M_PI / 180.0;
    CHECK(look.push[0] == Approx(weight * std::sin(angle)).epsilon(1e-9));
    CHECK(look.push[1] == Approx(-weight * std::cos(angle)).epsilon(1e-9));
    CHECK(result.contact.report.sliding_faces_max == 0);
    CHECK(result.ledger.entries().back().dissipated == 0.0);
    CHECK(result.ledger.entries().front().friction_energy > 0.0);
    double drift = 0.0;
    for (std::size_t i = 0; i < look.first.size(); ++i) drift = std::max(drift, std::abs(look.last[i] - look.first[i]));
    CHECK(drift < 1e-12);
}

TEST_CASE("a block that slides under the loads of the start is refused, with its name", "[run][settling]") {
    const run::Scene<2> scene = sliding_block(Kinematics::floating, 30.0);
    CHECK_THROWS_WITH(run::simulate<2>(scene, settling(0.3)),
                      Catch::Contains("'block' slides along x with") && Catch::Contains("do not come to rest"));
}

TEST_CASE("what does not come to rest is told by its motion: without friction a block slides, without a plane it falls",
          "[run][settling]") {
    run::Scene<2> scene = sliding_block(Kinematics::rigid, 10.0);
    // The plane is level, and the pull along it is g sin 10 deg.
    CHECK_THROWS_WITH(run::simulate<2>(scene, settling(0.0)), Catch::Contains("'block' slides along x without friction") &&
                                                                  Catch::Contains("give it friction (contact.friction)"));
    scene.solid.acceleration = {Vector<2>(0.0, g)};
    CHECK_THROWS_WITH(run::simulate<2>(scene, settling(0.0)),
                      Catch::Contains("'block' falls along y") && Catch::Contains("supports or springs"));
}

TEST_CASE("a body that nothing holds is refused before it moves where loads push it, and rests where they balance",
          "[run][settling]") {
    run::Scene<2> scene =
        block(GENERATE(Kinematics::small, Kinematics::floating, Kinematics::finite, Kinematics::rigid), 0.0);
    scene.solid.obstacles.clear();
    Watch watch;
    CHECK_THROWS_WITH(run::simulate<2>(scene, settling(0.0), watch), Catch::Contains("nothing holds 'block'") &&
                                                                         Catch::Contains("along -y with 3.2e+03 N") &&
                                                                         Catch::Contains("by supports or springs"));
    CHECK(watch.steps.empty());
    scene.solid.acceleration.clear();
    scene.solid.boundary.traction = {{.group = "xmin", .value = {1e3, 0.0}}, {.group = "xmax", .value = {-1e3, 0.0}}};
    const run::RunResult<2> result = run::simulate<2>(scene, settling(0.0), watch);
    REQUIRE(result.run.settling);
    CHECK(result.run.settling->speed < 1e-7);  // a strain of 1e-4 at the speed of sound is 1e-2 m/s
}

TEST_CASE("a body that nothing holds is refused before it moves where a couple turns it for ever, with the couple",
          "[run][settling]") {
    const Kinematics kinematics = GENERATE(Kinematics::small, Kinematics::floating, Kinematics::rigid);
    run::Scene<2> scene = block(kinematics, 0.0);
    scene.solid.obstacles.clear();
    scene.solid.acceleration.clear();
    const bool is_small = kinematics == Kinematics::small;
    scene.solid.boundary.traction = {{.group = "xmin", .value = {0.0, 1e3}, .history = {}, .follows = !is_small},
                                     {.group = "xmax", .value = {0.0, -1e3}, .history = {}, .follows = !is_small}};
    Watch watch;
    // 1e3 Pa times the height, and the width between both
    CHECK_THROWS_WITH(run::simulate<2>(scene, settling(0.0), watch),
                      Catch::Contains("nothing holds 'block'") && Catch::Contains("turn it with a couple of 320 N m"));
    CHECK(watch.steps.empty());
}

TEST_CASE("a body that a couple turns to where its dead loads balance comes to rest there", "[run][settling]") {
    run::Scene<2> scene = block(Kinematics::floating, 0.0);
    scene.solid.obstacles.clear();
    scene.solid.acceleration.clear();
    scene.solid.boundary.traction = {{.group = "xmin", .value = {-1e3, 1e2}}, {.group = "xmax", .value = {1e3, -1e2}}};
    Look look;
    const run::RunResult<2> result = run::simulate<2>(scene, settling(0.0), look);
    REQUIRE(result.run.settling);
    // The line from the first to the last cell of the lowest row has turned against x; strains are 1e-4.
    const double length = look.rest[28][0] - look.rest[0][0], rise = look.first[2 * 28 + 1] - look.first[1];
    CHECK(rise / length == Approx(-std::sin(std::atan(0.1))).epsilon(1e-3));
}

TEST_CASE("a free body comes to rest whatever its vibrations do from step to step", "[run][settling]") {
    run::Scene<2> scene;
    const int n = GENERATE(4, 5, 6, 7, 8);
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {1.0, 1.0}, {n, n}, mesh::CellShape::triangle, "block");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.3, .density = 1.0}};
    scene.velocity = {Vector<2>::Zero()};
    scene.solid.boundary.traction = {{.group = "xmin", .value = {-1e-4, 0.0}}, {.group = "xmax", .value = {1e-4, 0.0}}};
    const run::RunResult<2> result = run::simulate<2>(scene, settling(0.0));
    REQUIRE(result.run.settling);
    CHECK(result.run.settling->speed < 1e-9);  // the load at once makes it move at 1e-4 m/s
}

TEST_CASE("whoever watches is told how bodies come to rest, and can end it", "[run][settling]") {
    const run::Scene<2> scene = block(Kinematics::small, 0.0);
    Watch all;
    const run::RunResult<2> result = run::simulate<2>(scene, settling(0.0), all);
    REQUIRE(result.run.settling);
    CHECK(std::ssize(all.steps) == result.run.settling->steps / 50);
    CHECK(std::ranges::is_sorted(all.steps));
    CHECK(*std::ranges::max_element(all.speeds) > 0.0);
    Watch impatient;
    impatient.most = 2;
    CHECK_THROWS_WITH(run::simulate<2>(scene, settling(0.0), impatient),
                      Catch::Contains("asked to stop after 100 steps to rest") && Catch::Contains("nothing to go on from"));
}

TEST_CASE("velocities at the start act after the bodies have come to rest", "[run][settling]") {
    run::Scene<2> scene = block(Kinematics::floating, 0.0);
    scene.velocity = {Vector<2>(2.0, 0.0)};
    const run::RunResult<2> result = run::simulate<2>(scene, settling(0.3));
    CHECK(result.bodies.start[0].velocity[0] == Approx(2.0));
    CHECK(result.ledger.entries().front().kinetic == Approx(0.5 * 1000.0 * width * height * 4.0));
    CHECK(result.ledger.entries().front().time == 0.0);
}
