// What is said of bodies that obstacles do not hold, and of bodies that come together with themselves.
#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/warnings.hpp"

using namespace abut;
using run::WarningKind;

namespace {

/// A cube of 0.2 m, just above z = 0, under gravity.
run::Scene<3> cube(const Vector<3>& lower, const Vector<3>& velocity, contact::RigidObstacle<3> floor) {
    run::Scene<3> scene;
    scene.mesh =
        mesh::structured_box<3>(lower, lower + Vector<3>::Constant(0.2), {2, 2, 2}, mesh::CellShape::hexahedron, "cube");
    scene.solid.materials = {{.young = 1e5, .poisson = 0.0, .density = 1000.0}};
    scene.solid.acceleration = {Vector<3>(0.0, 0.0, -10.0)};
    scene.solid.obstacles = {std::move(floor)};
    scene.outputs.obstacles = {"floor"};
    scene.velocity = {velocity};
    scene.time = 0.4;
    return scene;
}

std::vector<run::Warning> of_kind(std::vector<run::Warning> warnings, WarningKind kind) {
    std::erase_if(warnings, [&](const run::Warning& warning) { return warning.kind != kind; });
    return warnings;
}

contact::RigidObstacle<3> table() { return contact::plane_obstacle<3>(Vector<3>::Zero(), Vector<3>(0.0, 0.0, 1.0), 1.0); }
contact::RigidObstacle<3> endless(double reach) {
    return contact::endless_plane_obstacle<3>(Vector<3>::Zero(), Vector<3>(0.0, 0.0, 1.0), Vector<3>::Zero(), reach);
}

/// A clip: two arms along x, 0.06 m apart, joined at the left. The arms fly towards each other.
run::Scene<2> clip(double speed) {
    const double width = 0.1, slot = 0.06, length = 1.0;
    const int n = 40;
    mesh::CellSoup<2> soup;
    soup.name = "clip";
    soup.body_names = {"clip"};
    std::vector<double> y;
    for (const double lower : {0.0, width + slot})
        for (int row = 0; row <= 4; ++row) y.push_back(lower + 0.25 * row * width);
    for (const double of_row : y)
        for (int i = 0; i <= n; ++i) soup.vertices.emplace_back(length * i / n, of_row);
    for (int row = 0; row + 1 < static_cast<int>(y.size()); ++row)
        for (int i = 0; i < n; ++i) {
            if (row == 4 && i > 3) continue;
            const int a = row * (n + 1) + i;
            const std::vector<std::int32_t> corners{a, a + 1, a + n + 2, a + n + 1};
            soup.cell_vertices.append(corners);
            soup.cell_shape.push_back(mesh::CellShape::quadrangle);
            soup.cell_body.push_back(0);
        }
    run::Scene<2> scene;
    scene.mesh = mesh::build_mesh<2>(std::move(soup));
    scene.solid.materials = {{.young = 1e5, .poisson = 0.3, .density = 1000.0}};
    scene.velocity = {Vector<2>::Zero()};
    scene.added_velocity = [=](const Vector<2>& x) {
        const double middle = width + 0.5 * slot;
        return Vector<2>(0.0, x.x() < 0.15 ? 0.0 : (x.y() < middle ? speed : -speed));
    };
    scene.time = 0.06 / speed;
    return scene;
}

}  // namespace

TEST_CASE("a body that slides off a floor with a rim is said, and one without a rim holds it", "[run][sightings]") {
    const auto law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    auto scene = cube({0.5, 0.0, 1e-4}, {4.0, 0.0, 0.0}, table());
    run::RunOptions options{.interval = 1};
    options.law = law;
    const auto off = run::simulate<3>(scene, options);
    const auto said = of_kind(run::warnings_after(off), WarningKind::past_rim);
    REQUIRE(said.size() == 1);
    CHECK(said[0].text.find("'cube'") != std::string::npos);
    CHECK(said[0].text.find("'floor'") != std::string::npos);
    CHECK(said[0].value == Approx(0.1).margin(0.02));  // its centre is 0.4 m from the rim
    CHECK(off.bodies.end[0].velocity.z() < -1.0);      // it falls
    scene.solid.obstacles = {endless(100.0)};
    const auto on = run::simulate<3>(scene, options);
    CHECK(of_kind(run::warnings_after(on), WarningKind::past_rim).empty());
    CHECK(std::abs(on.bodies.end[0].velocity.z()) < 0.2);
}

TEST_CASE("a body that falls past a floor beside it is said", "[run][sightings]") {
    const auto beside = run::simulate<3>(cube({3.0, 0.0, 0.1}, {0.0, 0.0, -0.1}, table()), {.interval = 1});
    const auto said = of_kind(run::warnings_after(beside), WarningKind::past_rim);
    REQUIRE(said.size() == 1);
    CHECK(said[0].value > 0.15);
    const auto above = run::simulate<3>(cube({3.0, 0.0, 0.1}, {0.0, 0.0, -0.1}, endless(1000.0)), {.interval = 1});
    CHECK(of_kind(run::warnings_after(above), WarningKind::past_rim).empty());
    CHECK(above.contact.report.active_pairs_max > 0);
}

TEST_CASE("obstacles that bodies can only meet from behind are said before the first step", "[run][sightings]") {
    const auto said = [](const run::Scene<3>& scene) {
        return of_kind(run::warnings_before(scene, run::RunResult<3>{}), WarningKind::behind_obstacle);
    };
    auto scene = cube({0.0, 0.0, 0.1}, Vector<3>::Zero(), table());
    CHECK(said(scene).empty());
    std::ranges::reverse(scene.solid.obstacles[0].faces[0]);
    auto found = said(scene);
    REQUIRE(found.size() == 1);
    CHECK(found[0].text.find("body 'cube' is behind obstacle 'floor'") != std::string::npos);
    CHECK(found[0].text.find("normal") != std::string::npos);
    scene.solid.ignored_pairs = {{1, 0}};
    CHECK(said(scene).empty());
    // Beside a face, as a riser of stairs is.
    auto beside =
        cube({0.0, 0.0, 0.1}, Vector<3>::Zero(), contact::plane_obstacle<3>({0.5, 0.1, -1.0}, {1.0, 0.0, 0.0}, 0.9));
    CHECK(said(beside).empty());
    // A surface of several faces that is wound the other way round.
    const auto tent = [](bool turned) {
        contact::RigidObstacle<3> surface{.faces = {{{-1.0, -1.0, -0.5}, {1.0, -1.0, -0.5}, {0.0, 0.0, 0.0}},
                                                    {{1.0, -1.0, -0.5}, {1.0, 1.0, -0.5}, {0.0, 0.0, 0.0}},
                                                    {{1.0, 1.0, -0.5}, {-1.0, 1.0, -0.5}, {0.0, 0.0, 0.0}},
                                                    {{-1.0, 1.0, -0.5}, {-1.0, -1.0, -0.5}, {0.0, 0.0, 0.0}}},
                                          .path = {}};
        if (turned)
            for (auto& face : surface.faces) std::ranges::reverse(face);
        return surface;
    };
    scene.solid.ignored_pairs.clear();
    scene.solid.obstacles = {tent(false)};
    CHECK(said(scene).empty());
    scene.solid.obstacles = {tent(true)};
    found = said(scene);
    REQUIRE(found.size() == 1);
    CHECK(found[0].text.find("all bodies are behind obstacle 'floor'") != std::string::npos);
}

TEST_CASE("a body that comes together with itself is said with its name and the place", "[run][sightings]") {
    auto scene = clip(0.1);
    const auto kinematics = GENERATE(solid::Kinematics::small, solid::Kinematics::finite, solid::Kinematics::floating);
    scene.solid.kinematics = {kinematics};
    scene.time *= 0.52;  // arms that flew freely would be 0.0024 m inside each other
    const auto result = run::simulate<2>(scene, {.interval = 10});
    const auto said = of_kind(run::warnings_after(result), WarningKind::near_itself);
    REQUIRE(said.size() == 1);
    CHECK(said[0].text.find("'clip'") != std::string::npos);
    REQUIRE(result.watch.sightings.near_themselves.size() == 1);
    CHECK(result.watch.sightings.near_themselves[0].gap_at_rest == Approx(0.06).epsilon(0.05));
    CHECK(result.watch.sightings.near_themselves[0].position.y() == Approx(0.13).margin(0.01));
    CHECK(result.watch.sightings.near_themselves[0].position.x() > 0.3);
    scene.time *= 0.4;  // before they meet
    CHECK(run::simulate<2>(scene, {.interval = 10}).watch.sightings.near_themselves.empty());
}

TEST_CASE("a body that goes through itself, where no contact acts within it, is an error with its name and the place",
          "[run][sightings]") {
    auto scene = clip(0.3);
    scene.solid.kinematics = {GENERATE(solid::Kinematics::small, solid::Kinematics::finite, solid::Kinematics::floating)};
    using Catch::Contains;
    CHECK_THROWS_WITH(run::simulate<2>(scene, {.interval = 10}),
                      Contains("body 'clip' goes through itself at (") && Contains("contact.self = true"));
}

TEST_CASE("contact within a body keeps its parts apart where it is asked for, under both laws", "[run][sightings]") {
    auto scene = clip(0.1);
    run::RunOptions options{.interval = 10};
    options.law = GENERATE(solid::ContactLaw::reconstruction, solid::ContactLaw::pair_potential);
    options.contact.search.self_contact = true;
    const auto result = run::simulate<2>(scene, options);
    CHECK(result.watch.sightings.near_themselves.empty());
    CHECK(result.contact.report.active_pairs_max > 0);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.ledger.largest_energy());
}
