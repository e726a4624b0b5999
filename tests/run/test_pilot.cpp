#include "abut/run/steps/pilot.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "abut/base/error.hpp"
#include "abut/run/steps/simulation.hpp"
#include "run/scenes.hpp"

using namespace abut;
using solid::Kinematics;

namespace {

const run::RunOptions automatic{.kinematics = run::BodyKinematics::automatic};

/// The block of `block_on_plane`, and the same beside it, 100 m away: nothing that it meets.
run::Scene<2> two_blocks(double speed) {
    run::Scene<2> scene = test::block_on_plane(speed);
    const auto other =
        mesh::structured_box<2>({100.0, 2e-3}, {101.0, 1.0 + 2e-3}, {2, 2}, mesh::CellShape::quadrangle, "far");
    scene.mesh = mesh::combine<2>(std::vector{scene.mesh, other});
    scene.solid.materials.push_back(scene.solid.materials.front());
    scene.velocity.push_back(scene.velocity.front());
    return scene;
}

/// A block of `young` that flies at 0.01 m/s onto one of 1 Pa.
run::Scene<2> block_on_block(double young) {
    run::Scene<2> scene = test::block_on_plane(0.01);
    const auto below = mesh::structured_box<2>({-1.0, -1.0}, {2.0, 0.0}, {6, 2}, mesh::CellShape::quadrangle, "below");
    scene.mesh = mesh::combine<2>(std::vector{scene.mesh, below});
    scene.solid.obstacles.clear();
    scene.solid.materials = {{.young = young, .poisson = 0.0, .density = 1.0},
                             {.young = 1.0, .poisson = 0.0, .density = 1.0}};
    scene.velocity.push_back(Vector<2>::Zero());
    return scene;
}

std::vector<Kinematics> picked(const run::Scene<2>& scene) { return run::choose_kinematics(scene, automatic).kinematics(); }

}  // namespace

TEST_CASE("automatic: a body that falls flat is small, one that turns floats, one that meets nothing is rigid",
          "[run][pilot]") {
    CHECK(picked(two_blocks(0.01)) == std::vector{Kinematics::small, Kinematics::rigid});
    run::Scene<2> turning = two_blocks(0.1);
    turning.added_velocity = [](const Vector<2>& x) -> Vector<2> {
        if (x[0] > 50.0) return Vector<2>::Zero();
        return 0.05 * Vector<2>(0.5 - x[1], x[0] - 0.5);
    };
    const run::PilotReport report = run::choose_kinematics(turning, automatic);
    CHECK(report.kinematics() == std::vector{Kinematics::floating, Kinematics::rigid});
    CHECK(report.bodies[0].rotation > 0.05);
    CHECK(report.bodies[1].rotation < 1e-12);
    CHECK(report.steps >= 200);
    CHECK(report.small > 0.0);
    CHECK(report.floating > 0.0);
    CHECK(report.rigid > 0.0);
}

TEST_CASE("automatic: beside a soft body a stiff one is rigid, and takes the share of two springs", "[run][pilot]") {
    CHECK(picked(block_on_block(1.0)) == std::vector{Kinematics::small, Kinematics::small});
    const run::PilotReport report = run::choose_kinematics(block_on_block(1e3), automatic);
    CHECK(report.kinematics() == std::vector{Kinematics::rigid, Kinematics::small});
    CHECK(report.bodies[0].strain_share == Approx(1e-3 * report.bodies[1].strain_share));
}

TEST_CASE("automatic: a body that vibrates at the start is not rigid", "[run][pilot]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.contact = false;
    scene.solid.obstacles.clear();
    CHECK(picked(scene) == std::vector{Kinematics::rigid});
    run::Scene<2> stretched = scene;
    stretched.displacement = [](const Vector<2>& x) -> Vector<2> { return {0.01 * (x[0] - 0.5), 0.0}; };
    CHECK(picked(stretched) == std::vector{Kinematics::small});
    run::Scene<2> stretching = scene;
    stretching.added_velocity = [](const Vector<2>& x) -> Vector<2> { return {0.01 * (x[0] - 0.5), 0.0}; };
    CHECK(picked(stretching) == std::vector{Kinematics::small});
}

TEST_CASE("an automatic run is the run with the kinematics that it picked", "[run][pilot]") {
    run::Scene<2> scene = block_on_block(1e3);
    scene.time = 5.0;
    std::int64_t seen = 0;
    scene.after_step = [&](const solid::Solid<2>&, double) { ++seen; };
    const run::RunResult<2> chosen = run::simulate<2>(scene, automatic);
    REQUIRE(chosen.run.pilot);
    CHECK(seen == chosen.run.steps);
    scene.solid.kinematics = {Kinematics::rigid, Kinematics::small};
    const run::RunResult<2> given = run::simulate<2>(scene);
    CHECK_FALSE(given.run.pilot);
    REQUIRE(chosen.run.steps == given.run.steps);
    CHECK(chosen.ledger.entries().back().energy == given.ledger.entries().back().energy);
    CHECK(chosen.contact.report.active_pairs_max > 0);
}

TEST_CASE("who takes the steps of a scene must ask for what automatic picks", "[run][pilot]") {
    CHECK_THROWS_AS(static_cast<void>(run::solid_options(two_blocks(0.01), automatic)), BadInput);
}

TEST_CASE("automatic refuses a scene that rigid bodies cannot be run in, and says who decides", "[run][pilot]") {
    run::Scene<2> scene = test::block_on_plane(0.01);
    scene.solid.boundary.dirichlet.push_back({.group = "xmin"});
    try {
        static_cast<void>(run::choose_kinematics(scene, automatic));
        FAIL("no error");
    } catch (const Error& error) {
        CHECK(std::string(error.what()).find("Choose the kinematics yourself") != std::string::npos);
    }
}
