#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/input/read_settings.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/steps/simulation.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;
namespace fs = std::filesystem;

/// Some steps of a scene of the project: it starts, and its pseudo-energy stays.
template <int Dim>
void run_some_steps(const input::SceneFile& file) {
    const run::RunResult<Dim> result = run::simulate<Dim>(file.scene<Dim>(), file.options());
    CHECK(result.run.steps == 12);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
    CHECK(result.contact.report.missed_contacts == 0);
}

}  // namespace

TEST_CASE("every scene of the project has no fault, starts, and keeps its pseudo-energy", "[input][scenes]") {
    int n = 0;
    for (const auto& entry : fs::directory_iterator(ABUT_SOURCE "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        CAPTURE(entry.path());
        const auto checked = input::check_scene(entry.path());
        CAPTURE(input::text_of(checked.faults));
        REQUIRE(checked.estimate);
        CHECK(checked.estimate->cells > 0);
        CHECK(checked.estimate->steps > 12);
        CHECK(checked.estimate->dt < checked.estimate->stable_dt);
        const input::SceneFile file(entry.path(), {.options = [](run::RunOptions& options) {
                                        options.time = run::not_given;
                                        options.steps = 12;
                                    }});
        file.dimension() == 2 ? run_some_steps<2>(file) : run_some_steps<3>(file);
        ++n;
    }
    CHECK(n == 57);
}

TEST_CASE("a bar of grains breaks half a pulse from its free end, and the piece flies off with the momentum of the striker",
          "[input][scenes][fracture]") {
    // In one dimension: a pulse twice as long as the striker, 0.5 m, meets its own reflection there; its momentum is trapped.
    const input::SceneFile file(fs::path(ABUT_SOURCE "/scenes/spalling_bar.toml"), {});
    const auto result = run::simulate<2>(file.scene<2>(), file.options());
    REQUIRE(result.bonds.fragments.size() == 2);
    const double height = 0.1, half_a_grain = 0.05, momentum = 0.02 * 0.5 * height;
    const solid::Fragment<2>& piece = result.bonds.fragments.back();
    CHECK(piece.mass == Approx(0.5 * height).margin(half_a_grain * height));
    CHECK(piece.mass * piece.velocity[0] > 0.9 * momentum);
    CHECK(piece.mass * piece.velocity[0] < momentum);
    CHECK(result.contact.report.missed_contacts == 0);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-12 * result.energy.scale.value);
    // One crack across the bar takes its fracture energy; other places have opened a little.
    CHECK(result.energy.dissipated.in_bonds > 2e-6 * height);
    CHECK(result.energy.dissipated.in_bonds < 2.0 * 2e-6 * height);
}

TEST_CASE(
    "a ring whose ends meet, a rolled-up sheet, and a needle that falls on its point press by no more than 0.3 of a cell",
    "[input][scenes][long]") {
    const std::string name = GENERATE("c_ring.toml", "falling_needle.toml", "rolled_sheet.toml");
    CAPTURE(name);
    const input::SceneFile file(fs::path(ABUT_SOURCE "/scenes") / name, {});
    const auto result = run::simulate<2>(file.scene<2>(), file.options());
    CHECK(result.contact.report.active_pairs_max > 2);
    CHECK(result.contact.report.missed_contacts == 0);
    CHECK(result.contact.report.compression_max <= 0.3);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-12 * result.energy.scale.value);
    CHECK(result.ledger.energy_excess() < 0.01 * result.energy.scale.value);
}

TEST_CASE("the estimate of a check is what the run takes", "[input][check]") {
    const WrittenScene written(two_blocks("time = 5"));
    const input::Overrides slow{.set = {"bodies.left.velocity=[0.01, 0]"}};
    const auto checked = input::check_scene(written.path(), slow);
    REQUIRE(checked.estimate);
    const input::SceneFile file(written.path(), slow);
    const auto result = run::simulate<2>(file.scene<2>(), file.options());
    CHECK(checked.estimate->bodies == 2);
    CHECK(checked.estimate->cells == 4 + 9);
    CHECK(checked.estimate->boundary_faces == 8 + 12);
    CHECK(checked.estimate->dt == result.run.dt);
    CHECK(checked.estimate->steps == result.run.steps);
    CHECK(checked.estimate->seconds > 0.0);
    CHECK(checked.estimate->seconds < 60.0);  // 13 cells and some dozen steps
    CHECK(checked.estimate->bytes > 1e6);     // no process with Gmsh is smaller
    for (const char* word : {"13", "takes", "about", "MB"})
        CHECK(input::text_of(*checked.estimate).find(word) != std::string::npos);
}

TEST_CASE("every key of [run], [contact], [output] and [laboratory] reaches its option", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml(steps = 3
time = 2
cfl = 0.5
dt = 1e-3
allow_unstable = true
integrator = "memm_async"
kinematics = "floating"
threads = 2
[contact]
enabled = false
law = "pair_potential"
facing_full = -0.4
facing_none = -0.1
skin = 0.25
compression_limit = 7
[output]
out = "somewhere"
interval = 5
frames = 4
[laboratory]
levels = 3
contact_margin = 2
contact_levels = 1
broad_phase = "brute_force"
overlap = "frozen"
weighting = "half"
area = "exact"
events = false
quadrature = 1
facing_cosine = -0.3
free_faces = "adjacent"
corners = "fixed"
)toml"));
    // Not all of them act beside each other (test_idle_keys.cpp): the scene is read, and no run.
    const auto settings = [&](const std::vector<std::string>& set) {
        return input::read_settings(written.path(), {.set = set}).settings;
    };
    const input::Settings file = settings({});
    const run::RunOptions& o = file.options;
    CHECK(o.time == 2.0);
    CHECK(o.steps == 3);
    CHECK(o.cfl == 0.5);
    CHECK(o.dt == 1e-3);
    CHECK(o.allow_unstable);
    CHECK(o.integrator == run::SolidIntegrator::memm_async);
    CHECK(o.levels == 3);
    CHECK(o.contact_margin == 2);
    CHECK(o.contact_levels == 1);
    CHECK(o.kinematics == run::BodyKinematics::floating);
    CHECK(o.threads == 2);
    CHECK(o.law == solid::ContactLaw::pair_potential);
    CHECK(o.contact.search.broad_phase == geometry::BroadPhase::brute_force);
    CHECK(o.contact.overlap == contact::OverlapMode::frozen);
    CHECK(o.contact.weighting == contact::InterfaceWeighting::half);
    CHECK(o.contact.area == geometry::AreaMethod::exact);
    CHECK_FALSE(o.contact.events);
    CHECK(o.contact.quadrature == 1);
    CHECK(o.contact.search.facing_cosine == -0.3);
    CHECK(o.facing.full == -0.4);
    CHECK(o.facing.none == -0.1);
    CHECK(o.contact.search.skin == 0.25);
    CHECK(o.contact.compression_limit == 7.0);
    CHECK(o.free_faces == solid::FreeFaceRule::adjacent);
    CHECK(o.corners == solid::CornerRule::fixed);
    CHECK(o.out == "somewhere");
    CHECK(o.interval == 5);
    CHECK(o.frames == 4);
    CHECK_FALSE(file.contact);

    const run::RunOptions memm = settings({"run.integrator=memm", "run.filter=neutral", "run.restart=9"}).options;
    CHECK(memm.filter);
    CHECK(memm.restart == 9);
    CHECK(settings({"run.integrator='bilbao'", "laboratory.gauge=3"}).options.gauge == 3.0);
    const run::RunOptions single = settings({"run.integrator=leapfrog", "laboratory.precision=single"}).options;
    CHECK(single.precision == solid::Precision::single_precision);
    CHECK(o.precision == solid::Precision::double_precision);
}

TEST_CASE("a preset stands below all other keys, wherever it stands", "[input][scenes]") {
    const WrittenScene written(two_blocks("cfl = 0.5\npreset = \"exact\"\n[laboratory]\nevents = true\n"));
    const run::RunOptions exact = input::SceneFile(written.path()).options();
    CHECK(exact.cfl == 0.5);
    CHECK(exact.filter);
    const run::RunOptions fast = input::SceneFile(written.path(), {.set = {"run.preset=fast"}}).options();
    CHECK(fast.cfl == 0.5);
    CHECK(fast.contact.events);
    CHECK_FALSE(fast.filter);
    const WrittenScene plain(two_blocks("preset = \"fast\""));
    CHECK(input::SceneFile(plain.path()).options().cfl == 0.99);
    CHECK_FALSE(input::SceneFile(plain.path()).options().contact.events);
}

TEST_CASE("a scene has the title and the comment of its file, over several lines if they are", "[input][scenes]") {
    const WrittenScene written("title = \"Two blocks\"\ncomment = \"\"\"They meet.\nThey part.\"\"\"\n" + two_blocks(""));
    const run::Scene<2> scene = input::SceneFile(written.path()).scene<2>();
    CHECK(scene.title == "Two blocks");
    CHECK(scene.comment == "They meet.\nThey part.");
    CHECK(input::SceneFile(WrittenScene(two_blocks("")).path()).scene<2>().title.empty());
}

TEST_CASE("bodies have their materials, motions and places", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([bodies.round]
shape = "disc"
radius = "1/4"
size = 0.1
place = [0, 5]
turn = "pi/6"
young = 3
poisson = 0.2
density = 4
kinematics = "rigid"
velocity = [0, -2]
spin = 6
)toml"));
    const input::SceneFile file(written.path(),
                                {.set = {"gravity=[0, -10]", "energy_scale=8", "bodies.left.young=7", "bodies.left.eta=5"}});
    const run::Scene<2> scene = file.scene<2>();
    CHECK(scene.mesh.body_names == std::vector<std::string>{"left", "right", "round"});
    REQUIRE(scene.solid.materials.size() == 3);
    CHECK(scene.solid.materials[0].young == 7.0);
    const solid::Material& material = scene.solid.materials[2];
    CHECK(material.young == 3.0);
    CHECK(material.poisson == 0.2);
    CHECK(material.density == 4.0);
    CHECK(scene.solid.materials[0].eta == 5.0);
    CHECK(scene.solid.kinematics ==
          std::vector{solid::Kinematics::small, solid::Kinematics::small, solid::Kinematics::rigid});
    CHECK(scene.velocity[0] == Vector<2>(1.0, 0.0));
    CHECK(scene.velocity[2] == Vector<2>(0.0, -2.0));
    CHECK(scene.spin[2][0] == 6.0);
    CHECK(scene.spin[1][0] == 0.0);
    CHECK(scene.solid.acceleration[1] == Vector<2>(0.0, -10.0));
    CHECK(scene.energy_scale.value == 8.0);
    for (const std::int32_t face : scene.mesh.group("round.boundary").faces)
        for (const std::int32_t vertex : scene.mesh.face_vertices[face])
            CHECK((scene.mesh.vertices[static_cast<std::size_t>(vertex)] - Vector<2>(0.0, 5.0)).norm() == Approx(0.25));
}

TEST_CASE("a material is shared by the bodies that name it, wherever it stands; values of a body go before",
          "[input][scenes]") {
    const WrittenScene written(R"toml(dim = 2
[bodies.a]
shape = "structured_box"
lower = [0, 0]
upper = [1, 1]
counts = [1, 1]
material = "rubber"
[bodies.b]
shape = "structured_box"
lower = [2, 0]
upper = [3, 1]
counts = [1, 1]
density = 7
material = "rubber"
[materials.rubber]
young = 2
poisson = 0.4
density = 3
eta = 5
[run]
steps = 1
)toml");
    const auto materials = input::SceneFile(written.path()).scene<2>().solid.materials;
    REQUIRE(materials.size() == 2);
    for (const solid::Material& material : materials) {
        CHECK(material.young == 2.0);
        CHECK(material.poisson == 0.4);
        CHECK(material.eta == 5.0);
    }
    CHECK(materials[0].density == 3.0);
    CHECK(materials[1].density == 7.0);
    const input::SceneFile set(written.path(), {.set = {"materials.rubber.density=4"}});
    CHECK(set.scene<2>().solid.materials[0].density == 4.0);
}

TEST_CASE("a body of a file is read from the folder of the scene, turned and placed", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([bodies.brick]
mesh = "brick.vtu"
turn = "pi/2"
place = [0, 4]
young = 1
density = 1
)toml"));
    const auto brick = mesh::structured_box<2>({0.0, 0.0}, {2.0, 1.0}, {2, 1}, mesh::CellShape::quadrangle);
    mesh::write_vtu(brick, written.path().parent_path() / "brick.vtu");
    const auto mesh = input::SceneFile(written.path()).scene<2>().mesh;
    REQUIRE(mesh.n_cells() == 13 + 2);
    CHECK((mesh.cell_centroid[13] - Vector<2>(-0.5, 4.5)).norm() < 1e-15);
    CHECK((mesh.cell_centroid[14] - Vector<2>(-0.5, 5.5)).norm() < 1e-15);
}

TEST_CASE("shapes in space are where their keys say", "[input][scenes]") {
    const WrittenScene written(R"toml(dim = 3
[bodies.brick]
shape = "structured_box"
lower = [0, 0, 0]
upper = [1, 2, 3]
counts = [1, 2, 3]
cells = "prism"
young = 1
density = 1
[bodies.rod]
shape = "cylinder"
radius = 0.5
length = 2
size = 0.4
place = [5, 0, 0]
turn = [0, "pi/2", 0]    # its axis along x
young = 1
density = 1
[bodies.ball]
shape = "sphere"
radius = 1
size = 0.5
place = [0, 5, 0]
refinement = {point = [1, 0, 0], size = 0.2, distance = 0.5}
young = 1
density = 1
[run]
steps = 1
)toml");
    const auto mesh = input::SceneFile(written.path()).scene<3>().mesh;
    CHECK(mesh.cell_shape[0] == mesh::CellShape::prism);
    const auto extent = [&](const char* group, int axis) {
        std::array<double, 2> range{1e9, -1e9};
        for (const std::int32_t face : mesh.group(group).faces)
            for (const std::int32_t vertex : mesh.face_vertices[face]) {
                const double x = mesh.vertices[static_cast<std::size_t>(vertex)][axis];
                range = {std::min(range[0], x), std::max(range[1], x)};
            }
        return range;
    };
    CHECK(extent("brick.zmax", 2) == std::array{3.0, 3.0});
    CHECK(extent("rod.side", 0)[0] == Approx(4.0));
    CHECK(extent("rod.side", 0)[1] == Approx(6.0));
    CHECK(extent("rod.side", 2)[1] == Approx(0.5).epsilon(0.1));
    CHECK(extent("ball.boundary", 1)[1] == Approx(6.0).epsilon(0.05));
    double near = 0.0, far = 0.0;  // mean size of the faces of the ball at x = 1 and at x = -1
    int n_near = 0, n_far = 0;
    for (const std::int32_t face : mesh.group("ball.boundary").faces) {
        const auto f = static_cast<std::size_t>(face);
        if (mesh.face_centroid[f].x() > 0.9) near += mesh.face_measure[f], ++n_near;
        if (mesh.face_centroid[f].x() < -0.5) far += mesh.face_measure[f], ++n_far;
    }
    CHECK(near / n_near < 0.5 * far / n_far);
}

TEST_CASE("a gear has its teeth between tips and ground, and its bore", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([bodies.wheel]
shape = "gear"
teeth = 16
radius = 2
bore = 1
cells_per_tooth = 2
place = [0, 9]
young = 1
density = 1
)toml"));
    const auto mesh = input::SceneFile(written.path()).scene<2>().mesh;
    double tip = 0.0, ground = 9.0;
    const auto distance = [&](std::int32_t vertex) { return (mesh.vertices[vertex] - Vector<2>(0.0, 9.0)).norm(); };
    for (const std::int32_t face : mesh.group("wheel.teeth").faces)
        for (const std::int32_t vertex : mesh.face_vertices[face])
            tip = std::max(tip, distance(vertex)), ground = std::min(ground, distance(vertex));
    CHECK(tip == Approx(2.25));  // a module of 0.25 above the pitch circle
    CHECK(ground == Approx(2.0 - 1.25 * 0.25));
    for (const std::int32_t face : mesh.group("wheel.bore").faces)
        for (const std::int32_t vertex : mesh.face_vertices[face]) CHECK(distance(vertex) == Approx(1.0));
    const std::size_t of_blocks = 8 + 12;
    CHECK(mesh.group("wheel.teeth").faces.size() + mesh.group("wheel.bore").faces.size() ==
          mesh.boundary_faces.size() - of_blocks);
}

TEST_CASE("a point of a probe may be that of its body before it is turned and placed", "[input][scenes]") {
    const WrittenScene written(R"toml(dim = 2
[run]
steps = 1
[bodies.bar]
shape = "structured_box"
lower = [0, 0]
upper = [2, 1]
counts = [4, 2]
turn = "90 deg"
place = [10, 20]
young = 1
density = 1
[output.probes.in_scene]
body = "bar"
point = [9.5, 21.5]
[output.probes.in_body]
body = "bar"
point = [1.5, 0.5]
in_body = true
)toml");
    const auto probes = input::SceneFile(written.path()).scene<2>().outputs.probes;
    REQUIRE(probes.size() == 2);
    CHECK((*probes[1].position - *probes[0].position).norm() < 1e-14);
}

TEST_CASE("probes, forces and fields are what [output] asks for", "[input][scenes]") {
    const WrittenScene written(two_blocks(R"toml([obstacles.floor]
shape = "plane"
point = [0, -1]
normal = [0, 1]
[output]
forces = true
sample_interval = 5
fields = ["stress", "gap"]
[output.probes.corner]
body = "right"
point = [1.6, "1/4"]
[output.probes.whole]
body = "left"
)toml"));
    const auto outputs = input::SceneFile(written.path()).scene<2>().outputs;
    CHECK(outputs.forces);
    CHECK(outputs.interval == 5);
    CHECK(outputs.fields.stress);
    CHECK(outputs.fields.gap);
    CHECK_FALSE(outputs.fields.velocity);
    CHECK_FALSE(outputs.fields.von_mises);
    CHECK_FALSE(outputs.fields.pressure);
    REQUIRE(outputs.probes.size() == 2);
    CHECK(outputs.probes[0].name == "corner");
    CHECK(outputs.probes[0].body == 1);
    CHECK(outputs.probes[0].position == Vector<2>(1.6, 0.25));
    CHECK(outputs.probes[1].body == 0);
    CHECK_FALSE(outputs.probes[1].position);
    CHECK(outputs.obstacles == std::vector<std::string>{"floor"});
}
