#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/steps/simulation.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::WrittenScene;

const std::string symmetry = "[[symmetry]]\npoint = [0, 0]\nnormal = [2, 0]\n";

std::string box(const std::string& name, double left, double right, int count, const std::string& more) {
    return fmt::format(
        "[bodies.{}]\nshape = \"structured_box\"\nlower = [{}, 0]\nupper = [{}, 1]\ncounts = [{}, 4]\nyoung = 100\n"
        "poisson = 0.25\ndensity = 1\n{}\n",
        name, left, right, count, more);
}

run::RunResult<2> result_of(const std::string& text) {
    const WrittenScene written("dim = 2\n" + text);
    const auto checked = input::check_scene(written.path());
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.faults.empty());
    const input::SceneFile file(written.path());
    auto result = run::simulate<2>(file.scene<2>(), file.options());
    CHECK(result.ledger.pseudo_energy_drift() < 1e-12 * result.energy.scale.value);
    CHECK(result.contact.report.missed_contacts == 0);
    return result;
}

std::string fault_of(const std::string& text) {
    const WrittenScene written("dim = 2\n" + text + "[run]\nsteps = 1\n");
    const auto faults = input::check_scene(written.path()).faults;
    CAPTURE(input::text_of(faults));
    REQUIRE(faults.size() == 1);
    return faults.front().text;
}

}  // namespace

TEST_CASE("a body that hits its plane of symmetry does what it does against its other half", "[input][symmetry]") {
    // Without lateral strain both are one problem. The springs of the pair potential become stiffer as they are pressed in, those of a pair
    // at another depth than those of one face: what differs is of second order in v/c, with the speed of sound c = 10 m/s.
    const double v = GENERATE(1.0, 0.1, 0.01);
    for (const auto& [law, tolerance] : {std::pair("reconstruction", 1e-12), {"pair_potential", 0.01 * v * v}}) {
        CAPTURE(law, v);
        const auto block = [v](const char* name, int side) {
            const double near = 0.01 * v * side, far = near + side;
            return fmt::format(
                "[bodies.{}]\nshape = \"structured_box\"\nlower = [{}, 0]\nupper = [{}, 1]\ncounts = [4, 4]\nyoung = "
                "100\npoisson = 0\ndensity = 1\nvelocity = [{}, 0]\n",
                name, std::min(near, far), std::max(near, far), -v * side);
        };
        const std::string run = fmt::format("[run]\ndt = 0.005\nsteps = 200\n[contact]\nlaw = \"{}\"\n", law);
        const auto whole = result_of(block("right", 1) + block("left", -1) + run);
        const auto half = result_of(block("right", 1) + symmetry + run);
        const auto &of_whole = whole.ledger.entries(), &of_half = half.ledger.entries();
        REQUIRE(of_whole.size() == of_half.size());
        double least = of_half.front().kinetic;
        for (std::size_t i = 0; i < of_half.size(); ++i) {
            CHECK(std::abs(of_whole[i].kinetic - 2.0 * of_half[i].kinetic) < tolerance * of_whole.front().kinetic);
            least = std::min(least, of_half[i].kinetic);
        }
        CHECK(least < 0.5 * of_half.front().kinetic);  // it did hit
    }
}

TEST_CASE("a plate that a plane of symmetry cuts swings as the whole one does", "[input][symmetry]") {
    const std::string run = "[tractions.pull]\ngroup = \"plate.xmax\"\nvalue = [1, 0]\n[run]\ndt = 0.005\nsteps = 200\n";
    const auto whole =
        result_of(box("plate", -1.0, 1.0, 16, "") + "[tractions.left]\ngroup = \"plate.xmin\"\nvalue = [-1, 0]\n" + run);
    const auto half = result_of(box("plate", 0.0, 1.0, 8, "") + symmetry + run);
    const auto &of_whole = whole.ledger.entries(), &of_half = half.ledger.entries();
    REQUIRE(of_whole.size() == of_half.size());
    double largest = 0.0;
    for (const auto& entry : of_half) largest = std::max(largest, entry.kinetic);
    for (std::size_t i = 0; i < of_half.size(); ++i)
        CHECK(of_whole[i].kinetic == Approx(2.0 * of_half[i].kinetic).margin(0.02 * largest));
}

TEST_CASE("faces on a plane of symmetry carry no contact, and others meet it without friction", "[input][symmetry]") {
    const WrittenScene written("dim = 2\n" + box("block", 0.0, 1.0, 4, "") + symmetry +
                               box("far", 2.0, 3.0, 4, "velocity = [-1, 0.5]") +
                               "[contact]\nfriction = 0.3\n[run]\nsteps = 1\n");
    const auto scene = input::SceneFile(written.path()).scene<2>();
    REQUIRE(scene.solid.boundary.dirichlet.size() == 1);
    const auto& roller = scene.solid.boundary.dirichlet.front();
    CHECK(roller.constraint == solid::Constraint::normal);
    CHECK(scene.mesh.group(roller.group).faces.size() == 4);
    REQUIRE(scene.solid.obstacles.size() == 1);
    REQUIRE(scene.solid.body_friction.size() == 2);
    for (const auto& pair : scene.solid.body_friction) CHECK_FALSE(pair.law.acts());
    const auto result = run::simulate<2>(scene, input::SceneFile(written.path()).options());
    CHECK(result.contact.report.active_pairs == 0);
}

TEST_CASE("what is not symmetric about a plane of symmetry is refused", "[input][symmetry]") {
    const auto cut = [](const std::string& more) { return fault_of(box("block", 0.0, 1.0, 2, more) + symmetry); };
    CHECK(cut("kinematics = \"floating\"")
              .find("symmetry[0] meets body 'block', which is of kinematics \"floating\" and is cut") != std::string::npos);
    CHECK(cut("velocity = [0.5, 1]").find("velocity has 0.5 m/s along the normal, 0 m/s is needed") != std::string::npos);
    CHECK(cut("spin = 1").find("spin is not about the normal") != std::string::npos);
    CHECK(fault_of("gravity = [-3, 0]\n" + box("block", 0.0, 1.0, 2, "") + symmetry).find("gravity is -3 m/s^2") !=
          std::string::npos);
    CHECK(fault_of(box("block", 0.5, 1.0, 2, "") + symmetry + "[contact]\nenabled = false\n").find("it does nothing") !=
          std::string::npos);
    CHECK(fault_of(box("block", -0.5, 1.0, 3, "") + symmetry)
              .find("has a cell of body 'block' 0.5 m behind it, 0 m is allowed") != std::string::npos);
    CHECK(
        fault_of(box("block", 0.0, 1.0, 2, "") + "[[symmetry]]\npoint = [0, 0]\nnormal = [0, 0]\n").find("normal is zero") !=
        std::string::npos);
}

TEST_CASE("two planes make a quarter, which is stretched as the whole plate is", "[input][symmetry]") {
    // A plate of 2 x 2 m that is pulled by 1 Pa along x, released from rest at its static stretch: nothing moves.
    const WrittenScene written(
        "dim = 2\n" + box("plate", 0.0, 1.0, 4, "") + symmetry +
        "[[symmetry]]\npoint = [5, 0]\nnormal = [0, 1]\n[tractions.pull]\ngroup = \"plate.xmax\"\nvalue = "
        "[1, 0]\n[run]\ndt = 0.005\nsteps = 50\n");
    const input::SceneFile file(written.path());
    auto scene = file.scene<2>();
    REQUIRE(scene.solid.boundary.dirichlet.size() == 2);
    for (const auto& roller : scene.solid.boundary.dirichlet) CHECK(scene.mesh.group(roller.group).faces.size() == 4);
    // Plane strain: strains (1 - nu^2)/E and -nu (1 + nu)/E
    scene.displacement = [](const Vector<2>& x) {
        return Vector<2>((1.0 - 0.0625) / 100.0 * x.x(), -0.25 * 1.25 / 100.0 * x.y());
    };
    const auto result = run::simulate<2>(scene, file.options());
    const double work = 0.5 * (1.0 - 0.0625) / 100.0;  // of the pull up to that stretch [J/m]
    for (const auto& entry : result.ledger.entries()) CHECK(entry.kinetic < 1e-20 * work);
}

TEST_CASE(
    "a face that nearly lies on a plane of symmetry is refused with its distance, and one on it or apart from it is not",
    "[input][symmetry]") {
    // Faces of 0.25 m: on it up to 2.5e-7 m, apart from 2.5e-5 m on.
    const auto block = [](const char* left) {
        return fmt::format(
                   "[bodies.block]\nshape = \"structured_box\"\nlower = [{}, 0]\nupper = [1, 1]\ncounts = [4, 4]\nyoung = "
                   "100\ndensity = 1\n",
                   left) +
               symmetry;
    };
    for (const char* near : {"1e-6", "2e-5"})
        CHECK_THAT(fault_of(block(near)), Catch::Contains("symmetry[0] has a face of body 'block'") &&
                                              Catch::Contains(fmt::format("{:.6g} m in front", std::stod(near))) &&
                                              Catch::Contains("2.5e-07 m") && Catch::Contains("2.5e-05 m"));
    for (const char* well : {"0", "1e-7", "3e-5", "0.1"}) {
        CAPTURE(well);
        const WrittenScene written("dim = 2\n" + block(well) + "[run]\nsteps = 1\n");
        CHECK(input::check_scene(written.path()).faults.empty());
    }
}
