// Runs of scenes as users write them, and what is said of them at their end.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/verdict.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using run::WarningKind;
using test::WrittenScene;

struct Ran {
    run::Scene<2> scene;
    run::RunResult<2> result;

    [[nodiscard]] bool warns_of(WarningKind kind) const {
        return std::ranges::any_of(run::all_warnings(scene, result), [kind](const auto& w) { return w.kind == kind; });
    }
    [[nodiscard]] std::string verdict() const { return run::verdict(scene, result).text; }
    [[nodiscard]] bool is_good() const { return run::verdict(scene, result).good; }
    [[nodiscard]] Vector<2> velocity(std::size_t body = 0) const { return result.bodies.end[body].velocity; }
};

Ran ran(const std::string& text, const std::vector<std::string>& set = {}) {
    const WrittenScene written(text);
    const input::SceneFile file(written.path(), {.set = set});
    Ran run{file.scene<2>(), {}};
    run.result = run::simulate<2>(run.scene, file.options());
    return run;
}

/// A square of 1 m, E = 1 MPa, 1,000 kg/m^3; `more` goes behind.
std::string square(const std::string& of_body, const std::string& more) {
    return R"toml(dim = 2
[bodies.block]
shape = "structured_box"
lower = [0, 0]
upper = [1, 1]
counts = [4, 4]
young = 1e6
density = 1000
)toml" + of_body +
           more;
}

const std::string floor_below = R"toml(
[obstacles.floor]
shape = "plane"
point = [0, -1]
normal = [0, 1]
)toml";

/// A wedge of 25 degrees in one column of triangles, its tip below, over a block that is held.
std::string tip_over_block() {
    return R"toml(dim = 2
[bodies.tip]
mesh = "tip.msh"
place = [0.013, 0.01]
young = 1
density = 1
velocity = [0, -0.02]
[bodies.block]
shape = "structured_box"
lower = [-0.5, -0.5]
upper = [0.5, 0]
counts = [20, 10]
young = 1
density = 1
[supports.ground]
group = "block.ymin"
[run]
time = 20
[output]
interval = 10
[contact]
law = "pair_potential"
)toml";
}

/// Blocks whose cells are long across the contact and narrow along it: docs/limits.md.
const char* const narrow_cells = R"toml(dim = 2
[bodies.narrow]
shape = "structured_box"
lower = [-0.5, 0.01]
upper = [0.5, 1.01]
counts = [60, 4]
young = 1
density = 1
velocity = [0.01, -0.05]
[bodies.block]
shape = "structured_box"
lower = [-0.6, -1]
upper = [0.6, 0]
counts = [67, 4]
young = 1
density = 1
[supports.ground]
group = "block.ymin"
[run]
time = 40
[output]
interval = 10
[contact]
law = "reconstruction"
)toml";

/// Three squares of triangles that come together with one corner each.
const char* const three_corners = R"toml(dim = 2
[bodies.b0]
shape = "structured_box"
lower = [0.0, 0.0]
upper = [1, 1]
counts = [6, 6]
cells = "triangle"
place = [0.021221648075015993, 0.021204755433160978]
velocity = [-0.014147765383343995, -0.014136503622107319]
young = 1
poisson = 0.3
density = 1
[bodies.b1]
shape = "structured_box"
lower = [0.0, 0.0]
upper = [1, 1]
counts = [6, 6]
cells = "triangle"
place = [-0.0289746809236615, 0.0077761086265564945]
turn = 2.0943951023931953
velocity = [0.019316453949107668, -0.00518407241770433]
young = 1
poisson = 0.3
density = 1
[bodies.b2]
shape = "structured_box"
lower = [0.0, 0.0]
upper = [1, 1]
counts = [6, 6]
cells = "triangle"
place = [0.0077530328486454985, -0.02898086405971747]
turn = 4.1887902047863905
velocity = [-0.005168688565763666, 0.01932057603981165]
young = 1
poisson = 0.3
density = 1
[run]
time = 40
)toml";

}  // namespace

TEST_CASE("a block that is pushed a thousand times faster than it was is as fast as its impulse says, and not diverged",
          "[input][verdict]") {
    const Ran push = ran(square("kinematics = \"floating\"\nvelocity = [0.01, 0]\n", R"toml(
[tractions.push]
group = "block.xmin"
pressure = 1000
[run]
time = 10
[output]
interval = 100
)toml"));
    const double exact = 0.01 + 1000.0 * 10.0 / (1000.0 * 1.0);  // v0 + p t / (rho L)
    CHECK(push.velocity().x() == Approx(exact).epsilon(1e-3));
    CHECK(push.result.run.complete);
    const double kinetic = 0.5 * 1000.0 * exact * exact;
    CHECK(push.result.energy.scale.value == Approx(kinetic).epsilon(0.01));  // not K0 = 0.05 J
    CHECK(push.result.energy.scale.name == "E");
    CHECK(push.result.energy.forces_from_outside == std::vector<std::string>{"tractions"});
    CHECK(run::momentum_note(push.result) == "not conserved: tractions");
    CHECK(std::isnan(run::momentum_drift(push.result)));
}

TEST_CASE("a block that a faster wall meets leaves at twice the wall's speed less its own", "[input][verdict]") {
    const Ran thrown = ran(R"toml(dim = 2
[bodies.block]
shape = "structured_box"
lower = [0.05, 0]
upper = [1.05, 0.1]
counts = [50, 5]
young = 100
poisson = 0
density = 1
velocity = [0.001, 0]
[obstacles.wall]
shape = "plane"
point = [0, 0.05]
normal = [1, 0]
velocity = [0.5, 0]
[run]
time = 0.5
filter = "neutral"
[contact]
compression_limit = 5
)toml");
    // An elastic bar; 1.5 % of the speed stay in vibrations that the cells disperse.
    CHECK(thrown.velocity().x() == Approx(2.0 * 0.5 - 0.001).epsilon(0.02));
    const double mass = 0.1;
    CHECK(thrown.result.energy.scale.value >= 0.5 * mass * 0.98);
    CHECK(thrown.result.energy.forces_from_outside == std::vector<std::string>{"obstacles"});
}

TEST_CASE("a block at rest that gravity lets fall needs no energy_scale", "[input][verdict]") {
    const Ran fall = ran("gravity = [0, -10]\n" + square("", floor_below + "[run]\ntime = 0.2\n"));
    const double time = fall.result.ledger.entries().back().time;
    CHECK(fall.velocity().y() == Approx(-10.0 * time).epsilon(1e-9));  // g t
    CHECK(fall.result.energy.scale.value == Approx(0.5 * 1000.0 * 4.0).epsilon(0.02));
    CHECK(run::momentum_drift(fall.result) < 1e-9 * 1000.0 * 2.0);  // less what gravity gave
    CHECK_THAT(fall.verdict(), Catch::Contains("Nothing touched: nearest at the end were 'block' and obstacle 'floor', "));
    CHECK(fall.result.watch.looks.nearest.distance == Approx(1.0 - 5.0 * time * time).epsilon(1e-6));
    CHECK_FALSE(fall.is_good());
}

TEST_CASE("of a scene in which nothing moves figures are 0, and none is no number", "[input][verdict]") {
    const Ran still = ran(square("", floor_below + "[run]\nsteps = 5\n"));
    CHECK(still.result.energy.scale.value == 0.0);
    CHECK_THAT(still.verdict(), Catch::Contains("Nothing has moved."));
    for (const std::string& text : {run::summary_json<2>("still", still.scene, still.result),
                                    run::closing_table<2>("still", still.scene, still.result)})
        CHECK_THAT(text, !Catch::Contains("nan") && !Catch::Contains("inf"));
}

TEST_CASE("cells that swing with an energy that never was there end as diverged", "[input][verdict]") {
    const WrittenScene written(narrow_cells);
    const input::SceneFile file(written.path());
    const auto scene = file.scene<2>();
    try {
        static_cast<void>(run::simulate<2>(scene, file.options()));
        FAIL("H - H~ is more than all energy that was there");
    } catch (const Diverged& error) {
        CHECK_THAT(error.what(), Catch::Contains("H - H~") && Catch::Contains(" of body '"));
        CHECK(error.facts().value > error.facts().allowed);
    }
}

TEST_CASE("a tip of 25 degrees that strikes a flat side keeps its energy, which without a facet across it grew 94 times",
          "[input][verdict]") {
    const WrittenScene written(tip_over_block());
    std::filesystem::copy_file(ABUT_SOURCE "/tests/input/tip_25.msh", written.path().parent_path() / "tip.msh");
    const input::SceneFile file(written.path());
    const auto result = run::simulate<2>(file.scene<2>(), file.options());
    CHECK(result.contact.report.active_pairs_max > 0);
    CHECK(result.contact.report.missed_contacts == 0);
    CHECK(result.ledger.energy_excess() <= 1e-3 * result.energy.accounts.energy_in_play);
    CHECK(result.ledger.entries().back().linear_momentum[1] > 0.0);  // it is on its way back
}

TEST_CASE("corners that meet and shake their cells are told of, and H~ is no praise then", "[input][verdict]") {
    for (const char* law : {"contact.law=\"reconstruction\"", "contact.law=\"pair_potential\""}) {
        const Ran corners = ran(three_corners, {law});
        const double excess = corners.result.ledger.energy_excess() / corners.result.energy.accounts.energy_in_play;
        CAPTURE(law, excess);
        CHECK(corners.warns_of(WarningKind::energy_excess) == (excess > 0.02));
        if (excess <= 0.02) continue;
        CHECK_FALSE(corners.is_good());
        CHECK_THAT(corners.verdict(), !Catch::Contains("kept to round-off") && !Catch::Contains("none missed"));
    }
}

TEST_CASE("blocks that bounce are kept to round-off, apart, and nothing warns", "[input][verdict]") {
    const Ran bounce = ran(test::two_blocks(), {"run.steps=300", "bodies.left.velocity=[0.2, 0]"});
    REQUIRE(bounce.result.contact.report.active_pairs_max > 0);
    CAPTURE(bounce.verdict());
    CHECK(bounce.result.watch.looks.looks > 0);
    CHECK(bounce.result.watch.looks.deepest.ratio < run::deep_interpenetration);
    CHECK(run::momentum_note(bounce.result).empty());
    CHECK(run::momentum_drift(bounce.result) < 1e-13);
}

TEST_CASE("what an obstacle gives is accounted for: a block that bounces off a floor keeps the rest of its momentum",
          "[input][verdict]") {
    const Ran bounce = ran("gravity = [0, -10]\n" + square("velocity = [0, -1]\n", floor_below + "[run]\ntime = 0.8\n"));
    REQUIRE(bounce.result.contact.report.active_pairs_max > 0);
    CHECK(run::momentum_note(bounce.result) == ", less what came from gravity and obstacles");
    CHECK(run::momentum_drift(bounce.result) < 1e-12 * 1000.0 * bounce.result.energy.accounts.speed * 10.0);
}

TEST_CASE("bodies at rest stay at rest, in any units, wherever they stand, and of any kinematics", "[input][verdict]") {
    struct Units {
        double length, young, density, place;
    };
    // SI; mm, t and s; micrometres; a hundred kilometres from the origin
    const auto [length, young, density, place] = GENERATE(Units{1.0, 1e9, 1000.0, 0.0}, Units{1e3, 1e3, 1e-9, 0.0},
                                                          Units{1e-6, 1e9, 1000.0, 0.0}, Units{1.0, 1e9, 1000.0, 1e5});
    const std::string kinematics = GENERATE("floating", "rigid", "finite", "small");
    CAPTURE(length, place, kinematics);
    std::string scene = "dim = 2\n";
    for (const auto& [name, left] : {std::pair("a", place), {"b", place + 1.001 * length}})
        scene += fmt::format(
            "[bodies.{}]\nshape = \"structured_box\"\nlower = [{}, 0]\nupper = [{}, {}]\ncounts = [8, 8]\ncells = "
            "\"triangle\"\nyoung = {}\ndensity = {}\nkinematics = \"{}\"\n",
            name, left, left + length, length, young, density, kinematics);
    const Ran still = ran(scene + "[run]\nsteps = 500\n[output]\ninterval = 1\n");
    const double rounding = 2.0 * std::numeric_limits<double>::epsilon() * (place + 2.0 * length) / still.result.run.dt;
    for (std::size_t body : {0, 1}) CHECK(still.velocity(body).norm() <= rounding);
    CHECK(still.result.energy.scale.value == 0.0);
    CHECK_THAT(still.verdict(), Catch::Contains("Nothing has moved.") && Catch::Contains("Nothing warns."));
    CHECK(still.is_good());
}

TEST_CASE("a block at rest that is pulled later is as fast as its impulse says, wherever the run ends", "[input][verdict]") {
    const std::string scene = square("kinematics = \"floating\"\n",
                                     "[tractions.pull]\ngroup = \"block.xmax\"\nvalue = [\"t < 0.2 ? 0 : 100\", "
                                     "0]\nfollows = true\n[run]\ntime = 1\n[output]\ninterval = 1\n");
    const Ran pulled = ran(scene);
    const double end = pulled.result.ledger.entries().back().time, dt = pulled.result.run.dt;
    CHECK(pulled.velocity().x() ==
          Approx(100.0 * (end - 0.2) / 1000.0).margin(0.1 * 2.0 * dt));  // p t / (rho L), to two steps
    const auto onset = static_cast<int>(0.2 / dt);
    for (int steps = onset - 1; steps < onset + 4; ++steps) {
        const Ran short_run = ran(scene, {fmt::format("run.time={}", (steps + 0.5) * dt)});
        CHECK(short_run.result.run.complete);
        const bool moves = short_run.velocity().x() > 1e-6;
        CHECK(moves == (short_run.verdict().find("Nothing has moved") == std::string::npos));
    }
}

TEST_CASE("a rigid block at rest leaves a wall that comes at twice its speed", "[input][verdict]") {
    const Ran thrown = ran(square("kinematics = \"rigid\"\n",
                                  "[obstacles.wall]\nshape = \"plane\"\npoint = [-0.001, 0]\nnormal = [1, 0]\nvelocity = "
                                  "[0.1, 0]\n[run]\ntime = 0.2\n"));
    CHECK(thrown.velocity().x() == Approx(2.0 * 0.1).epsilon(1e-3));
    CHECK(thrown.is_good());
}

TEST_CASE("mass_damping is an outside force: momentum falls by exp(-alpha t), and no figure calls that a fault",
          "[input][verdict]") {
    const Ran damped = ran(
        square("kinematics = \"floating\"\nmass_damping = 2\nvelocity = [0.01, 0]\nspin = 0.01\n", "[run]\ntime = 0.5\n"));
    CHECK(damped.velocity().x() == Approx(0.01 * std::exp(-2.0 * damped.result.ledger.entries().back().time)).epsilon(0.01));
    CHECK(run::momentum_note(damped.result) == "not conserved: mass_damping");
    CHECK(run::moment_note(damped.result) == "not conserved: mass_damping");
    CHECK_FALSE(damped.warns_of(WarningKind::moment_drift));
    CHECK(damped.is_good());
}

TEST_CASE("bonded blocks whose corners coincide, and hit a floor together, are right and called so", "[input][verdict]") {
    const Ran bonded = ran(R"toml(dim = 2
[bodies.a]
shape = "structured_box"
lower = [-1, 0.01]
upper = [0, 0.41]
counts = [10, 4]
young = 1
density = 1
velocity = [0, -0.01]
[bodies.b]
shape = "structured_box"
lower = [0, 0.01]
upper = [1, 0.41]
counts = [9, 3]
young = 1
density = 1
velocity = [0, -0.01]
[[bonds]]
bodies = ["a", "b"]
[obstacles.floor]
shape = "plane"
point = [0, 0]
normal = [0, 1]
[run]
time = 5
)toml");
    CHECK(bonded.result.contact.report.active_pairs_max > 0);
    CHECK(bonded.warns_of(WarningKind::coincident_vertices));  // a note
    CHECK_THAT(bonded.verdict(), Catch::Contains("Nothing warns."));
    CHECK(bonded.is_good());
}

TEST_CASE("of two bodies that turn by 0.2 rad only the one that grows is told of", "[input][verdict]") {
    const auto turning = [](const char* kinematics, double left) {
        return fmt::format(
            "[bodies.{}]\nshape = \"structured_box\"\nlower = [{}, 0]\nupper = [{}, 1]\ncounts = [4, 4]\nyoung = "
            "1e6\ndensity = 1000\nspin = 1\nkinematics = \"{}\"\n",
            kinematics, left, left + 1.0, kinematics);
    };
    const std::string end = "[run]\ntime = 0.2\n";
    CHECK_FALSE(ran("dim = 2\n" + turning("floating", 0.0) + end).warns_of(WarningKind::rotation));
    const Ran both = ran("dim = 2\n" + turning("floating", 0.0) + turning("small", 3.0) + end);
    CHECK(both.warns_of(WarningKind::rotation));
    CHECK(both.result.watch.turned.name == "'small'");
    CHECK(both.result.watch.turned.angle == Approx(std::atan(0.2)).epsilon(0.02));  // velocities stay: x grows along a line
    const std::string resting = turning("small", 3.0);
    CHECK_FALSE(ran("dim = 2\n" + turning("floating", 0.0) + resting + end, {"bodies.small.spin=0"})
                    .warns_of(WarningKind::rotation));
}

TEST_CASE("a block that must stick and glides is told of with a remedy, and with it sticks", "[input][verdict]") {
    const double angle = 25.0 * std::numbers::pi / 180.0, mu = 0.6;  // tan 25 degrees = 0.466 < mu
    const auto block = [&](double friction, const std::string& damping, const std::string& run) {
        return ran(fmt::format(R"toml(dim = 2
gravity = [0, -10]
[bodies.b]
shape = "structured_box"
lower = [-0.2, 0]
upper = [0.2, 0.1]
counts = [8, 2]
young = 1e7
density = 1000
kinematics = "floating"
turn = {}
{}
[contact]
friction = {}
[obstacles.p]
shape = "plane"
point = [0, 0]
normal = [{}, {}]
half_width = 20
[run]
time = 0.5
{}
)toml",
                               -angle, damping, friction, std::sin(angle), std::cos(angle), run));
    };
    const Ran gliding = block(mu, "", "");
    CHECK(gliding.velocity().norm() > 0.05);  // it should stick
    CHECK(gliding.warns_of(WarningKind::weak_friction));
    CHECK_FALSE(gliding.is_good());
    CHECK(gliding.result.watch.weak_friction.share < 0.9);
    CHECK(gliding.result.watch.weak_friction.body_2 == "obstacle 'p'");
    const Ran remedied = block(mu, "stiffness_damping = 1e-4", "settle = true");
    CHECK(remedied.velocity().norm() < 1e-3);
    CHECK_FALSE(remedied.warns_of(WarningKind::weak_friction));
    // With less than tan 25 degrees it slides, by all the friction there is.
    const Ran sliding = block(0.2, "stiffness_damping = 1e-4", "");
    const double time = sliding.result.ledger.entries().back().time;
    CHECK(sliding.velocity().norm() == Approx(10.0 * time * (std::sin(angle) - 0.2 * std::cos(angle))).epsilon(0.02));
    CHECK_FALSE(sliding.warns_of(WarningKind::weak_friction));
}

TEST_CASE("a drift of H~ is seen whatever scale figures are quoted on, and nothing that is found fault with is praised",
          "[input][verdict]") {
    const run::Scene<2> scene;
    for (const double scale : {0.5, 1.0, 1e9}) {
        run::RunResult<2> result;
        result.energy.scale = {"H0", scale};
        dynamics::LedgerEntry<2> entry{};
        entry.energy = entry.pseudo_energy = entry.kinetic = 1.0;
        for (const double drift : {0.0, 2e-10}) {
            entry.energy = entry.pseudo_energy = 1.0 + drift;
            result.ledger.record(entry);
            result.energy.accounts.record(entry, 1.0, Vector<2>::Zero());
            const run::Verdict said = run::verdict(scene, result);
            CHECK(said.good == (drift == 0.0));
            CHECK((said.text.find("Nothing warns") == std::string::npos) == (drift > 0.0));
        }
        result.ledger = {};
        result.ledger.record(entry);
        result.watch.looks.nearest = {.body_1 = "'a'", .body_2 = "'b'", .distance = 1.0};
        CHECK_FALSE(run::verdict(scene, result).good);
        CHECK_THAT(run::verdict(scene, result).text, !Catch::Contains("Nothing warns"));
    }
}
