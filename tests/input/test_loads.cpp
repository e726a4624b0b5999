#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>

#include "abut/run/steps/simulation.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;

/// Mean over a run of the integral of the displacement along x over the area [m^3].
class MeanPull : public run::Observer<2> {
public:
    explicit MeanPull(const mesh::Mesh<2>& mesh) : mesh_(mesh) {}
    void look(const dynamics::RunView<2>& view, solid::Solid<2>& solid) override {
        const auto u = solid.cells().displacement(view.q);
        for (std::size_t cell = 0; cell < u.size(); ++cell) moment_ += mesh_.cell_measure[cell] * u[cell].x();
        ++n_;
    }
    [[nodiscard]] double mean() const { return moment_ / n_; }

private:
    const mesh::Mesh<2>& mesh_;
    double moment_ = 0.0;
    int n_ = 0;
};

/// Pairs of bodies that have touched by the end of a run.
struct ContactSeen : public run::Observer<2> {
    void look(const dynamics::RunView<2>&, solid::Solid<2>& solid) override {
        for (const auto& pair : solid.contact().impulses()) pairs.insert({pair.body_1, pair.body_2});
    }
    std::set<std::array<std::int32_t, 2>> pairs;
};

/// How far two bodies have turned, counted on over whole turns [rad].
struct Turns : public run::Observer<2> {
    void look(const dynamics::RunView<2>& view, solid::Solid<2>& solid) override {
        const auto motions = solid::body_motions<2>(view, solid);
        for (std::size_t body = 0; body < 2; ++body) turned[body] += (view.time - time) * motions[body].spin[0];
        time = view.time;
    }
    std::array<double, 2> turned{};
    double time = 0.0;
};

}  // namespace

TEST_CASE("supports and tractions have values or formulas in time and place", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([supports.moved]
group = "left.xmin"
constraint = "components"
components = ["y"]
value = [0, "2*t + x*y"]
[supports.held]
group = "right.ymin"
constraint = "normal"
value = [0.1, 0.2]
[tractions.pressed]
group = "right.ymax"
value = [0, "-3"]
follows = true
)toml"));
    const auto boundary = input::SceneFile(written.path()).scene<2>().solid.boundary;
    REQUIRE(boundary.dirichlet.size() == 2);
    CHECK(boundary.dirichlet[0].group == "left.xmin");
    CHECK(boundary.dirichlet[0].constraint == solid::Constraint::components);
    CHECK(boundary.dirichlet[0].components == std::array{false, true});
    CHECK(boundary.dirichlet[0].history(3.0, Vector<2>(2.0, 5.0)) == Vector<2>(0.0, 16.0));
    CHECK(boundary.dirichlet[1].constraint == solid::Constraint::normal);
    CHECK(boundary.dirichlet[1].value == Vector<2>(0.1, 0.2));
    CHECK_FALSE(boundary.dirichlet[1].history);
    REQUIRE(boundary.traction.size() == 1);
    CHECK(boundary.traction[0].value == Vector<2>(0.0, -3.0));
    CHECK(boundary.traction[0].follows);
}

TEST_CASE("12 teeth turn 18 two thirds as far, the other way round", "[input][scenes]") {
    const input::SceneFile file(ABUT_SOURCE "/scenes/gears.toml");
    Turns turns;
    const auto result = run::simulate<2>(file.scene<2>(), file.options(), turns);
    CHECK(turns.turned[0] == Approx(3.0).epsilon(0.05));  // 60 s with 0.05 rad/s
    // As far as 2/3, up to the play of 2 * 0.01 m at 1.5 m and as much again for teeth that bend
    CHECK(turns.turned[1] == Approx(-turns.turned[0] / 1.5).margin(2.0 * 2.0 * 0.01 / 1.5));
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
    CHECK(result.contact.report.missed_contacts == 0);
}

TEST_CASE("a pile that a paddle stirs gains the work of it exactly, and loses no contact", "[input][scenes]") {
    const input::SceneFile file(ABUT_SOURCE "/scenes/pile.toml");
    ContactSeen seen;
    const run::Scene<2> scene = file.scene<2>();
    const auto result = run::simulate<2>(scene, file.options(), seen);
    const std::int32_t paddle = scene.mesh.n_bodies() + 1;
    CHECK(std::ranges::any_of(seen.pairs, [&](const auto& pair) { return pair[1] == paddle; }));
    CHECK(std::abs(result.ledger.entries().back().work) > 1e-3 * result.energy.scale.value);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
    CHECK(result.contact.report.missed_contacts == 0);
}

TEST_CASE("equal bars that collide exchange their velocities, as the theory of one dimension has it", "[input][scenes]") {
    const input::SceneFile file(ABUT_SOURCE "/scenes/colliding_bars.toml");
    const auto result = run::simulate<2>(file.scene<2>(), file.options());
    CHECK(result.bodies.end[0].velocity.x() == Approx(-0.1).epsilon(0.03));
    CHECK(result.bodies.end[1].velocity.x() == Approx(0.1).epsilon(0.03));
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
    CHECK(result.contact.report.missed_contacts == 0);
}

TEST_CASE("bodies that are ignored pass through each other and through obstacles, and all others do not",
          "[input][contact]") {
    // b flies from the left through a, which rests, and meets c; a falls through the floor, on which c stands. Bodies that
    // are rigid come last in the contact of bodies that turn: numbers must not get mixed up.
    const WrittenScene written(R"toml(dim = 2
gravity = [0, -0.01]
[materials.soft]
young = 4
density = 1
[bodies.a]
shape = "structured_box"
lower = [0, 0]
upper = [1, 1]
counts = [2, 2]
material = "soft"
[bodies.b]
shape = "structured_box"
lower = [-0.9, 0.3]
upper = [-0.1, 0.8]
counts = [3, 2]
material = "soft"
velocity = [1, 0]
[bodies.c]
shape = "structured_box"
lower = [1.5, 0]
upper = [2.5, 1]
counts = [3, 3]
material = "soft"
[obstacles.floor]
shape = "plane"
point = [0, 0]
normal = [0, 1]
half_width = 9
[contact]
ignored_pairs = [["b", "a"], ["floor", "a"]]
[run]
time = 2.5
)toml");
    const auto [law, of_a, of_c] = GENERATE(table<std::string, std::string, std::string>(
        {{"reconstruction", "small", "small"}, {"pair_potential", "small", "small"}, {"automatic", "rigid", "floating"}}));
    CAPTURE(law, of_a);
    const input::SceneFile file(
        written.path(), {.set = {"contact.law=" + law, "bodies.a.kinematics=" + of_a, "bodies.c.kinematics=" + of_c}});
    ContactSeen seen;
    const auto result = run::simulate<2>(file.scene<2>(), file.options(), seen);
    CHECK(seen.pairs == std::set<std::array<std::int32_t, 2>>{{1, 2}, {2, 3}});
    CHECK(result.bodies.end[0].velocity.x() == Approx(0.0).margin(1e-14));
    const double time = result.ledger.entries().back().time;
    CHECK(result.bodies.end[0].velocity.y() == Approx(-0.01 * time).epsilon(1e-10));  // it falls freely
    CHECK(result.bodies.end[1].velocity.x() < 0.5);                                   // has met c
    CHECK(result.bodies.end[2].velocity.x() > 0.1);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
    const WrittenScene overlapping(two_blocks("[contact]\nignored_pairs = [[\"right\", \"left\"]]"));
    CHECK(input::check_scene(overlapping.path(), {.set = {"bodies.right.place=[-1, 0]"}}).faults.empty());
    const input::SceneFile crossed(overlapping.path(), {.set = {"bodies.right.place=[-1, 0]"}});
    CHECK_NOTHROW(run::simulate<2>(crossed.scene<2>(), crossed.options()));
}

TEST_CASE("bonds glue bodies or groups of faces, and faults name what is wrong with them", "[input][scenes]") {
    const std::vector<std::string> touching{"bodies.right.place=[-0.5, 0]"};
    const WrittenScene written(two_blocks(R"toml([[bonds]]
bodies = ["left", "right"]
strength = 3
[[bonds]]
bodies = ["left"]
groups = ["right.xmin"]
)toml"));
    const input::SceneFile file(written.path(), {.set = touching});
    const auto scene = file.scene<2>();
    REQUIRE(scene.solid.bonds.size() == 2);
    CHECK(scene.solid.bonds[0].sides == std::array<std::int32_t, 2>{0, 1});
    CHECK(scene.solid.bonds[0].strength == 3.0);
    CHECK(scene.solid.bonds[1].sides[0] == 0);
    CHECK(scene.mesh.groups[static_cast<std::size_t>(scene.solid.bonds[1].sides[1] - 2)].name == "right.xmin");
    CHECK(std::isinf(scene.solid.bonds[1].strength));

    const WrittenScene glued(two_blocks("[[bonds]]\nbodies = [\"left\", \"right\"]\n"));
    std::vector<std::string> longer = touching;
    longer.insert(longer.end(), {"run.steps=200", "run.dt=0.02"});
    const input::SceneFile run_file(glued.path(), {.set = longer});
    const auto result = run::simulate<2>(run_file.scene<2>(), run_file.options());
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
    CHECK(result.contact.report.active_pairs_max == 0);
    CHECK((result.bodies.end[0].velocity + result.bodies.end[1].velocity).x() == Approx(1.0).epsilon(1e-10));
    CHECK(std::abs(result.bodies.end[1].velocity.x()) > 1e-3);  // nothing else moves it

    const WrittenScene untouched(
        two_blocks("[obstacles.floor]\nshape = \"plane\"\npoint = [0, -1]\nnormal = [0, 1]\n"
                   "[[bonds]]\ngroups = [\"left.xmax\", \"right.xmin\"]\n"));
    longer.push_back("contact.enabled=false");  // as a scene is tried: its obstacles may be idle
    const input::SceneFile without_contact(untouched.path(), {.set = longer});
    const auto same = run::simulate<2>(without_contact.scene<2>(), without_contact.options());
    CHECK(same.bodies.end[1].velocity == result.bodies.end[1].velocity);

    const auto faults = [&](const std::string& bonds) {
        const WrittenScene wrong(two_blocks(bonds));
        return input::text_of(input::check_scene(wrong.path(), {.set = touching}).faults);
    };
    using Catch::Contains;
    CHECK_THAT(faults("[[bonds]]\nbodies = [\"left\"]"), Contains("name 1 together, 2 are needed"));
    CHECK_THAT(faults("[[bonds]]\nbodies = [\"left\", \"rigth\"]"), Contains("'rigth', which is no body"));
    CHECK_THAT(faults("[[bonds]]\nbodies = [\"left\", \"right\"]\nstrength = -1"), Contains("strength is -1 Pa"));
    CHECK_THAT(faults("[[bonds]]\ngroups = [\"left.xmin\", \"right.xmin\"]"),
               Contains("no face of one lies on one of the other"));
}

TEST_CASE("a piece that is glued on and as long as the bar that strikes flies off with its velocity", "[input][scenes]") {
    const input::SceneFile file(ABUT_SOURCE "/scenes/bonded_bars.toml");
    const auto result = run::simulate<2>(file.scene<2>(), file.options());
    CHECK(result.bodies.end[2].velocity.x() == Approx(0.1).epsilon(0.05));  // less what the bond bears
    CHECK(std::abs(result.bodies.end[0].velocity.x()) < 0.005);
    CHECK(std::abs(result.bodies.end[1].velocity.x()) < 0.005);
    CHECK(result.energy.dissipated.in_bonds > 0.0);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-12 * result.energy.scale.value);
    CHECK(result.contact.report.missed_contacts == 0);
}

TEST_CASE("a pressure acts against the normals of all faces of its group", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([bodies.round]
shape = "disc"
radius = 0.25
size = 0.1
place = [0, 5]
young = 3
density = 4
[tractions.blown]
group = "round.boundary"
pressure = "3*t + x*y"
[tractions.pressed]
group = "left.ymax"
pressure = 2
)toml"));
    const run::Scene<2> scene = input::SceneFile(written.path()).scene<2>();
    std::size_t n_faces = 0;
    for (const auto& traction : scene.solid.boundary.traction)
        for (const std::int32_t face : scene.mesh.group(traction.group).faces) {
            const Vector<2>& x = scene.mesh.face_centroid[face];
            const bool of_round = x.y() > 4.0;
            CHECK(traction.follows);  // whatever its body is run as
            const double pressure = of_round ? 3.0 * 0.5 + x.x() * x.y() : 2.0;
            const Vector<2> value = traction.history ? traction.history(0.5, x) : traction.value;
            CHECK((value + pressure * scene.mesh.face_normal[face]).norm() < 1e-14);
            ++n_faces;
        }
    CHECK(n_faces == scene.mesh.group("round.boundary").faces.size() + 2);
}

TEST_CASE("springs are between bodies or a body and the ground, and moments on bodies", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([springs.between]
from = {body = "left", point = [1, 0.5], radius = 0.25}
to = {body = "right", point = [1.5, "1/2"]}
stiffness = 3
damping = 4
[springs.axle]
from = {point = [2, 0.5]}
to = {body = "right", point = [2, 0.5]}
stiffness = 5
[springs.tense]
from = {point = [0, 0]}
to = {body = "left", point = [0, 0]}
stiffness = 5
length = 7
[moments.drive]
body = "right"
value = 8
damping = 9
[moments.ramp]
body = "left"
value = "8 * t"
)toml"));
    const auto solid = input::SceneFile(written.path()).scene<2>().solid;
    REQUIRE(solid.springs.size() == 3);
    CHECK(solid.springs[0].first.body == 0);
    CHECK(solid.springs[0].first.position == Vector<2>(1.0, 0.5));
    CHECK(solid.springs[0].first.radius == 0.25);
    CHECK(solid.springs[0].second.body == 1);
    CHECK(solid.springs[0].stiffness == 3.0);
    CHECK(solid.springs[0].damping == 4.0);
    CHECK(solid.springs[0].length == 0.5);  // at rest it is not tense
    CHECK(solid.springs[1].first.body == solid::ground);
    CHECK(solid.springs[1].length == 0.0);  // a hinge
    CHECK(solid.springs[2].length == 7.0);
    REQUIRE(solid.moments.size() == 2);
    CHECK(solid.moments[1].history(0.25)[0] == 2.0);  // 8 t
    CHECK(solid.moments[1].damping == 0.0);
    CHECK_FALSE(solid.moments[0].history);
    CHECK(solid.moments[0].body == 1);
    CHECK(solid.moments[0].moment[0] == 8.0);
    CHECK(solid.moments[0].damping == 9.0);
}

TEST_CASE("a plate that a growing traction pulls moves as plane strain has it", "[input][scenes]") {
    const input::SceneFile file(ABUT_SOURCE "/scenes/pulled_plate.toml");
    const run::Scene<2> scene = file.scene<2>();
    MeanPull pull(scene.mesh);
    const auto result = run::simulate<2>(scene, file.options(), pull);
    // Under t_0 = 1 Pa u = t_0 x (1 - nu^2)/E; its integral over 0.5 m^2, with the mean of x 1/2, is a quarter of that at
    // the end. The traction grows as (1 - cos(pi t/2))/2 for 2 s, 1/2 on the mean, and stays for 2 s: 3/4 over all.
    const double end = 0.91 / 100.0;
    CHECK(pull.mean() == Approx(0.75 * 0.5 * end * 0.5).epsilon(0.02));
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
}
