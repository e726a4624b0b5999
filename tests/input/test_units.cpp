#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;
using Set = std::vector<std::string>;

run::Scene<2> scene_with(const Set& set, const std::string& more = "") {
    const WrittenScene written(two_blocks(more));
    return input::SceneFile(written.path(), {.set = set}).scene<2>();
}

/// The message of a scene with one fault.
std::string fault_of(const Set& set, const std::string& more = "") {
    const WrittenScene written(two_blocks(more));
    const auto checked = input::check_scene(written.path(), {.set = set});
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.faults.size() == 1);
    return checked.faults.front().text;
}

double density_by(const std::string& text, const std::string& values) {
    return scene_with({"bodies.left.density='" + text + "'"}, "[values]\n" + values).solid.materials.front().density;
}

}  // namespace

TEST_CASE("a scene with units is bitwise that with the numbers of SI", "[input][units]") {
    const auto units =
        scene_with({"bodies.left.young='210 GPa'", "bodies.left.density=7.85 g/cm^3", "bodies.left.velocity=['3 m/s', 0]",
                    "bodies.left.place=['-25 mm', '1 km']", "gravity=[0, '-9810 mm/s^2']"});
    const auto plain = scene_with({"bodies.left.young=210e9", "bodies.left.density=7850", "bodies.left.velocity=[3, 0]",
                                   "bodies.left.place=[-0.025, 1000]", "gravity=[0, -9.81]"});
    CHECK(units.solid.materials.front().young == plain.solid.materials.front().young);
    CHECK(units.solid.materials.front().density == plain.solid.materials.front().density);
    CHECK(units.velocity == plain.velocity);
    CHECK(units.solid.acceleration == plain.solid.acceleration);
    REQUIRE(units.mesh.vertices.size() == plain.mesh.vertices.size());
    for (std::size_t i = 0; i < plain.mesh.vertices.size(); ++i)
        CHECK(units.mesh.vertices[static_cast<std::int32_t>(i)] == plain.mesh.vertices[static_cast<std::int32_t>(i)]);
}

TEST_CASE("angles and angular velocities are read in degrees and turns", "[input][units]") {
    const double pi = std::numbers::pi;
    CHECK(scene_with({"bodies.left.kinematics=floating", "bodies.left.spin='30 deg/s'"}).spin.front()[0] ==
          Approx(pi / 6.0).epsilon(1e-15));
    CHECK(scene_with({"bodies.left.kinematics=floating", "bodies.left.spin='1200 rpm'"}).spin.front()[0] ==
          Approx(40.0 * pi).epsilon(1e-15));
    const auto turned = scene_with({"bodies.left.turn='90 deg'"});  // about its own origin, a corner
    double leftmost = 0.0;
    for (const Vector<2>& x : turned.mesh.vertices) leftmost = std::min(leftmost, x.x());
    CHECK(leftmost == Approx(-1.0).epsilon(1e-14));
}

TEST_CASE("options of tables take units, those that are no SI unit among them", "[input][units]") {
    const WrittenScene written(two_blocks("time = \"5 ms\"\n[output]\ncheckpoint = \"90 s\"\n"));
    const input::SceneFile file(written.path());
    CHECK(file.options().time == 0.005);
    CHECK(file.options().checkpoint == 1.5);  // [min]
}

TEST_CASE("a value of [values] has a unit, and formulas of such values are checked against that of their key",
          "[input][units]") {
    const std::string values = "edge = \"2 cm\"\nmass = \"16 g\"\n";
    CHECK(density_by("mass/edge^3", values) == Approx(0.016 / 8e-6).epsilon(1e-15));
    CHECK(density_by("rho", values + "cube = \"edge^3\"\nrho = \"mass/cube\"\n") == Approx(2000.0).epsilon(1e-15));
    CHECK(density_by("(2*3) g/cm^3", "") == 6000.0);
    CHECK(density_by("(n) g/cm^3", "n = 4") == 4000.0);
    CHECK(density_by("n*edge", "n = 4\nedge = \"2 cm\"") == 0.08);  // n may have any unit
    const auto fault = [&](const std::string& text) {
        return fault_of({"bodies.left.density='" + text + "'"}, "[values]\n" + values);
    };
    CHECK(fault("mass/edge^2").find("it is m^-2 kg, a density is needed") != std::string::npos);
    CHECK(fault("mass/edge^3 + 1").find("it mixes dimensions") != std::string::npos);
    CHECK(fault("mass/edge^3*exp(edge)").find("it mixes dimensions") != std::string::npos);
    CHECK(fault("(mass/edge^3) g/cm^3").find("Leave out the unit behind it") != std::string::npos);
    CHECK(fault_of({"run.cfl='edge/mass'"}, "[values]\n" + values).find("a plain number is needed") != std::string::npos);
}

TEST_CASE("the dimension of a formula is that of its value, whatever functions it is made of", "[input][units]") {
    for (const std::string formula : {"sqrt(a^2 + b^2)", "min(a, b)", "a*sin(a/b)", "a^3/b/b"}) {
        const std::string text =
            fault_of({"bodies.left.density='" + formula + "'"}, "[values]\na = \"3 mm\"\nb = \"4 mm\"\n");
        CHECK(text.find("it is a length, a density is needed") != std::string::npos);
    }
    const auto fast =
        scene_with({"bodies.left.velocity=['sqrt(E/rho)', 0]"}, "[values]\nE = \"70 GPa\"\nrho = \"2.7 g/cm^3\"\n");
    CHECK(fast.velocity.front().x() == Approx(std::sqrt(70e9 / 2700.0)).epsilon(1e-15));
    const auto longer = scene_with({"bodies.left.place=['-(a > b ? a : b)', 0]"}, "[values]\na = \"3 mm\"\nb = \"4 mm\"\n");
    CHECK(longer.mesh.vertices[0].x() == Approx(-0.004).epsilon(1e-15));
}

TEST_CASE("a formula that varies has a unit behind its parentheses", "[input][units]") {
    const auto scene = scene_with({}, "[supports.pull]\ngroup = \"right.xmax\"\nvalue = [\"(3*t) mm\", \"(0.5*x) mm\"]\n");
    REQUIRE(scene.solid.boundary.dirichlet.size() == 1);
    const auto& history = scene.solid.boundary.dirichlet.front().history;
    REQUIRE(history);
    CHECK(history(2.0, Vector<2>(4.0, 0.0)).isApprox(Vector<2>(0.006, 0.002), 1e-15));
}

TEST_CASE("a value and the same in any other unit of its dimension are one", "[input][units]") {
    for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{{"1 Pa", 1.0},
                                                                                 {"2 kPa", 2e3},
                                                                                 {"3 MPa", 3e6},
                                                                                 {"4 N/mm^2", 4e6},
                                                                                 {"5 bar", 5e5},
                                                                                 {"6 kN/m^2", 6e3},
                                                                                 {"7 J/m^3", 7.0},
                                                                                 {"8 kg/m/s^2", 8.0}}) {
        CAPTURE(text);
        CHECK(scene_with({"bodies.left.young='" + text + "'"}).solid.materials.front().young == value);
    }
}
