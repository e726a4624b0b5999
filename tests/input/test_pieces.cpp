// Bodies of several materials: by the groups of a file, or by regions.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "abut/run/steps/simulation.hpp"
#include "abut/run/words/summary.hpp"
#include "abut/run/words/warnings.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::WrittenScene;

std::string wheel(const std::string& of_body, const std::string& more = "") {
    return R"toml(dim = 2
[bodies.wheel]
shape = "disc"
radius = 0.3
size = 0.06
place = [1, 2]
kinematics = "floating"
young = 1e6
density = 1000
)toml" + of_body +
           R"toml([bodies.wheel.hub]
region = "sqrt(x^2 + y^2) < 0.18"
young = 4e6
density = 3000
)toml" + more +
           "[run]\nsteps = 30\n";
}

template <int Dim>
run::Scene<Dim> piece_scene(const std::string& text) {
    const WrittenScene written(text);
    const auto checked = input::check_scene(written.path());
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.faults.empty());
    return input::SceneFile(written.path()).scene<Dim>();
}

/// 6 x 3 squares cut into triangles, of two groups that share the vertices between them.
void write_plate(const std::filesystem::path& path) {
    std::ofstream file(path);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"left\"\n2 2 "
            "\"right\"\n$EndPhysicalNames\n$Nodes\n28\n";
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 7; ++i) file << 7 * j + i + 1 << ' ' << i << ' ' << j << " 0\n";
    file << "$EndNodes\n$Elements\n36\n";
    int number = 0;
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 6; ++i) {
            const int a = 7 * j + i + 1, group = i < 3 ? 1 : 2;
            file << ++number << " 2 2 " << group << ' ' << group << ' ' << a << ' ' << a + 1 << ' ' << a + 8 << '\n';
            file << ++number << " 2 2 " << group << ' ' << group << ' ' << a << ' ' << a + 8 << ' ' << a + 7 << '\n';
        }
    file << "$EndElements\n";
}

bool is_piece_refused(const std::string& text, const std::string& words) {
    const WrittenScene written(text);
    const auto faults = input::check_scene(written.path()).faults;
    return std::ranges::any_of(faults,
                               [&](const input::Fault& fault) { return fault.text.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("a region of a body is a part with its own material, bonded to the rest for ever", "[input][pieces]") {
    const auto scene = piece_scene<2>(wheel(""));
    CHECK(scene.mesh.body_names == std::vector<std::string>{"wheel.hub", "wheel.rest"});
    CHECK(scene.solid.materials[0].young == 4e6);
    CHECK(scene.solid.materials[1].young == 1e6);
    CHECK(scene.solid.kinematics[0] == solid::Kinematics::floating);
    REQUIRE(scene.solid.bonds.size() == 1);
    CHECK(scene.solid.bonds[0].sides == std::array{0, 1});
    CHECK(std::isinf(scene.solid.bonds[0].strength));
    CHECK(scene.solid.ignored_pairs == std::vector<std::array<std::int32_t, 2>>{{0, 1}});
    for (std::int32_t cell = 0; cell < scene.mesh.n_cells(); ++cell)
        CHECK(((scene.mesh.cell_centroid[cell] - Vector<2>(1.0, 2.0)).norm() < 0.18) == (scene.mesh.cell_body[cell] == 0));
    CHECK(piece_scene<2>(wheel("", "[contact]\nself = true\n")).solid.ignored_pairs.empty());
}

TEST_CASE("a body says for itself whether it touches itself", "[input][pieces]") {
    const auto blocks = [](const std::string& left, const std::string& contact) {
        std::string text = test::two_blocks(contact);
        text.insert(text.find("[bodies.right]"), left);
        return text;
    };
    using Pairs = std::vector<std::array<std::int32_t, 2>>;
    const auto self = [](const std::string& text) {
        const WrittenScene written(text);
        return input::SceneFile(written.path()).options().contact.search.self_contact;
    };
    const auto ignored = [](const std::string& text) { return piece_scene<2>(text).solid.ignored_pairs; };
    CHECK_FALSE(self(blocks("", "")));
    CHECK(self(blocks("self = true\n", "")));
    CHECK(ignored(blocks("self = true\n", "")) == Pairs{{1, 1}});
    CHECK(self(blocks("self = false\n", "[contact]\nself = true\n")));
    CHECK(ignored(blocks("self = false\n", "[contact]\nself = true\n")) == Pairs{{0, 0}});
    CHECK(ignored(blocks("", "[contact]\nself = true\n")).empty());
}

TEST_CASE("the parts of a piece fly and turn as one", "[input][pieces]") {
    const auto scene = piece_scene<2>(wheel("velocity = [3, 0]\nspin = 7\n", "[contact]\nenabled = true\n"));
    run::RunOptions options;
    options.steps = 400;
    const auto result = run::simulate<2>(scene, options);
    CHECK(result.ledger.pseudo_energy_drift() < 1e-11 * result.energy.scale.value);
    // All that the bond and the strain of the spin have of the energy, which is 1e-4 of it.
    const auto& ledger = result.ledger.entries();
    CHECK(ledger.back().potential < 1e-3 * ledger.front().kinetic);
    for (const auto& part : result.bodies.end)
        CHECK(part.spin[0] == Approx(7.0).epsilon(0.01));  // released unstrained, it swings
}

TEST_CASE("groups of a file that share vertices are parts of one piece", "[input][pieces]") {
    const WrittenScene written(R"toml(dim = 2
[bodies.plate]
mesh = "plate.msh"
young = 1
density = 1
[bodies.plate.right]
young = 4
[bodies.plate.right.unknown]
[run]
steps = 3
)toml");
    write_plate(written.path().parent_path() / "plate.msh");
    std::string text;
    {
        std::ifstream in(written.path());
        text.assign(std::istreambuf_iterator<char>(in), {});
    }
    CHECK(input::check_scene(written.path()).faults.size() == 1);  // the unknown table
    text.erase(text.find("[bodies.plate.right.unknown]\n"), 29);
    std::ofstream(written.path()) << text;
    const auto checked = input::check_scene(written.path());
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.faults.empty());
    const auto scene = input::SceneFile(written.path()).scene<2>();
    CHECK(scene.mesh.body_names == std::vector<std::string>{"plate.left", "plate.right"});
    CHECK(scene.solid.materials[1].young == 4.0);
    CHECK(scene.solid.materials[1].density == 1.0);
    REQUIRE(scene.solid.bonds.size() == 1);
    CHECK(scene.mesh.report.n_coincident_vertices == 0);
}

TEST_CASE("a body that may break is cut into grains, whose bonds have its strength", "[input][pieces][fracture]") {
    const auto plate = [](const std::string& more) {
        return "dim = 2\n[bodies.plate]\nshape = \"box\"\nlower = [0, 0]\nupper = [1, 1]\nsize = 0.1\nyoung = 1e6\n"
               "density = 1e3\nvelocity = [1, 0]\nspin = 2\n" +
               more + "[run]\ntime = 1\n";
    };
    const std::string fracture = "fracture = {grain = 0.4, strength = 3e4, fracture_energy = 90, weibull = 8, seed = 5}\n";
    const auto scene = piece_scene<2>(plate("kinematics = \"floating\"\n" + fracture));
    REQUIRE(scene.mesh.n_bodies() >= 4);
    CHECK(scene.mesh.body_names.front() == "plate.1");
    CHECK(scene.mesh.group("plate.xmin").faces.size() == 10);
    CHECK(scene.solid.bonds.size() == scene.mesh.report.joined_bodies.size());
    for (const solid::Bond& bond : scene.solid.bonds) {
        CHECK(bond.strength == 3e4);
        CHECK(bond.fracture_energy == 90.0);
        CHECK(bond.weibull_modulus == 8.0);
        CHECK(bond.seed == 5);
        CHECK(bond.of_grains);
    }
    CHECK(scene.solid.ignored_pairs.empty());  // what comes off may touch the rest
    Vector<2> momentum = Vector<2>::Zero();    // they fly and turn as one
    for (std::int32_t cell = 0; cell < scene.mesh.n_cells(); ++cell)
        momentum += scene.mesh.cell_measure[cell] * scene.velocity[static_cast<std::size_t>(scene.mesh.cell_body[cell])];
    CHECK((momentum - Vector<2>(1.0, 0.0)).norm() < 1e-12);
    const WrittenScene small(plate(fracture));
    CHECK(input::text_of(input::check_scene(small.path()).faults).find("may break, and pieces that come off turn") !=
          std::string::npos);
    CHECK(is_piece_refused(plate("kinematics = \"floating\"\n" + fracture) + "[contact]\nenabled = false\n",
                           "body 'plate' may break, and with contact.enabled = false its pieces pass through each other"));
    CHECK(is_piece_refused(plate("kinematics = \"floating\"\nfracture = {grain = 4, strength = 1}\n"),
                           "leave each body whole"));
    CHECK(is_piece_refused(plate("kinematics = \"rigid\"\n" + fracture), "fracture"));
    CHECK(is_piece_refused(plate("kinematics = \"floating\"\n" + fracture + "[bodies.plate.hub]\nregion = \"x < 0.5\"\n"),
                           "the body has 2 parts, and one that breaks is made of one"));
}

TEST_CASE("a body whose bonds open over less than a cell is warned of, with E G/strength^2 over the size of its cells",
          "[input][pieces][fracture]") {
    const auto warned = [](double energy) {
        const std::string text =
            "dim = 2\n[bodies.plate]\nshape = \"structured_box\"\nlower = [0, 0]\nupper = [1, 1]\ncounts = "
            "[10, 10]\nyoung = 1e6\ndensity = 1e3\nkinematics = \"floating\"\nfracture = {grain = 0.4, "
            "strength = 1e4, fracture_energy = " +
            std::to_string(energy) + "}\n[run]\nsteps = 1\n";
        const WrittenScene written(text);
        const input::SceneFile file(written.path());
        const run::Scene<2> scene = file.scene<2>();
        const run::RunResult<2> result = run::simulate<2>(scene, file.options());
        std::vector<double> values;
        for (const run::Warning& warning : run::warnings_before(scene, result))
            if (warning.kind == run::WarningKind::short_cohesive_length) values.push_back(warning.value);
        CHECK(nlohmann::json::parse(run::summary_json("test", scene, result))["bonds"]["cohesive_length"].get<double>() ==
              Approx(1e6 * energy / (1e4 * 1e4) / 0.1).epsilon(1e-9));
        return values;
    };
    CHECK(warned(11.0).empty());  // 1.1 cells
    REQUIRE(warned(9.0).size() == 1);
    CHECK(warned(9.0).front() == Approx(0.9).epsilon(1e-9));
}

TEST_CASE("a plate that bursts dissipates its fracture energy, and a run whose bonds are off it by 2 % is warned of",
          "[input][pieces][fracture]") {
    const double energy = 1e-7;
    const WrittenScene written(
        "dim = 2\n[bodies.plate]\nshape = \"structured_box\"\nlower = [0, 0]\nupper = [1, 1]\ncounts = "
        "[12, 12]\nyoung = 1\ndensity = 1\npoisson = 0\nspin = 0.1\nkinematics = \"floating\"\nfracture = {grain = 0.3, "
        "strength = 1e-3, fracture_energy = 1e-7}\n[run]\ntime = 3\n");
    const input::SceneFile file(written.path());
    const run::Scene<2> scene = file.scene<2>();
    run::RunResult<2> result = run::simulate<2>(scene, file.options());
    REQUIRE(result.bonds.broken_share == 1.0);
    double area = 0.0;
    for (const auto& coverage : result.bonds.coverage) area += coverage.area;
    CHECK(result.energy.dissipated.in_bonds == Approx(energy * area).epsilon(1e-3));
    CHECK(result.bonds.beyond_fracture_energy ==
          Approx(result.energy.dissipated.in_bonds - energy * area).margin(1e-12 * energy));
    const auto warned = [&] {
        std::vector<double> values;
        for (const run::Warning& warning : run::warnings_after(result))
            if (warning.kind == run::WarningKind::fracture_energy) values.push_back(warning.value);
        return values;
    };
    CHECK(warned().empty());
    for (const double off : {-0.02, 0.02}) {
        result.energy.dissipated.in_bonds = (1.0 + off) * energy * area;
        result.bonds.beyond_fracture_energy = off * energy * area;
        REQUIRE(warned().size() == 1);
        CHECK(warned().front() == Approx(0.02).epsilon(1e-9));
        CHECK_FALSE(run::without_notes(run::warnings_after(result)).empty());
    }
}

TEST_CASE("grains that springs hold together are warned of: finite ones and those of metal, and no others",
          "[input][pieces][fracture]") {
    const auto bonds_warned_of = [](const std::string& keys) {
        const WrittenScene written(
            "dim = 2\n[bodies.plate]\nshape = \"structured_box\"\nlower = [0, 0]\nupper = [1, 1]\ncounts = "
            "[10, 10]\nyoung = 1e6\ndensity = 1e3\nfracture = {grain = 0.4, strength = 1e4}\n" +
            keys + "[run]\nsteps = 1\n");
        const input::SceneFile file(written.path());
        const run::Scene<2> scene = file.scene<2>();
        const run::RunResult<2> result = run::simulate<2>(scene, file.options());
        double n = 0.0;
        for (const run::Warning& warning : run::warnings_before(scene, result))
            if (warning.kind == run::WarningKind::scattered_grains) n += warning.value;
        return n / static_cast<double>(scene.solid.bonds.size());
    };
    CHECK(bonds_warned_of("kinematics = \"floating\"\n") == 0.0);
    CHECK(bonds_warned_of("kinematics = \"finite\"\n") == 1.0);
    CHECK(bonds_warned_of("kinematics = \"floating\"\nlaw = \"j2\"\nyield_stress = 1e5\n") == 1.0);
}

TEST_CASE("parts of a piece that cannot be are refused with the reason", "[input][pieces]") {
    CHECK(is_piece_refused(wheel("", "[bodies.wheel.rest]\nvelocity = [1, 0]\n"), "velocity or spin differs"));
    CHECK(is_piece_refused(wheel("", "[bodies.wheel.rest]\nkinematics = \"rigid\"\n"), "'wheel.rest' is rigid"));
    CHECK(is_piece_refused(wheel("", "[bodies.wheel.rim]\nregion = \"x > 5\"\nyoung = 1\ndensity = 1\n"),
                           "'rim' has 0 cells"));
    CHECK(is_piece_refused(wheel("", "[bodies.wheel.rim]\nyoung = 1\ndensity = 1\n"), "rim"));
    CHECK(is_piece_refused(wheel("region = \"x > 0\"\n"), "region"));
}
