#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "abut/solid/material/known_materials.hpp"
#include "input/scenes.hpp"

namespace {

using namespace abut;
using test::two_blocks;
using test::WrittenScene;

/// A block that has this material alone.
solid::Material of_block(const std::string& keys, const std::string& tables = "") {
    const WrittenScene written(R"toml(dim = 2
[bodies.block]
shape = "structured_box"
lower = [0, 0]
upper = [1, 1]
counts = [4, 4]
)toml" + keys + "\n" + tables + "\n[run]\nsteps = 1\n");
    const auto checked = input::check_scene(written.path());
    CAPTURE(input::text_of(checked.faults));
    REQUIRE(checked.faults.empty());
    return input::SceneFile(written.path()).scene<2>().solid.materials.front();
}

}  // namespace

TEST_CASE("a body takes the values of a material that is known by its name", "[input][materials]") {
    const solid::Material steel = of_block("material = \"steel S235\"");
    CHECK(steel.young == 210e9);
    CHECK(steel.poisson == 0.3);
    CHECK(steel.density == 7850.0);
    CHECK(steel.law == solid::MaterialLaw::st_venant_kirchhoff);
    CHECK(steel.flow.yield_stress == 0.0);  // of j2 alone
    const solid::Material heavy = of_block("material = \"steel S235\"\ndensity = \"8 g/cm^3\"");
    CHECK(heavy.density == 8000.0);
    CHECK(heavy.young == 210e9);
}

TEST_CASE("a known material gives its yield stress to the law that needs one, unless the body has another",
          "[input][materials]") {
    const std::string yields = "material = \"steel S355\"\nlaw = \"j2\"\nkinematics = \"finite\"\n";
    CHECK(of_block(yields).flow.yield_stress == 355e6);
    CHECK(of_block(yields + "yield_stress = \"400 MPa\"").flow.yield_stress == 400e6);
    // Johnson and Cook 1983, table 1: OFHC copper has A = 90 MPa, B = 292 MPa, n = 0.31, C = 0.025.
    const solid::Material copper = of_block("material = \"copper OFHC\"\nlaw = \"j2\"");
    CHECK(copper.flow.yield_stress == 90e6);
    CHECK(copper.flow.stress(0.2) == Approx(90e6 + 292e6 * std::pow(0.2, 0.31)));
    CHECK(copper.flow.rate_factor(1e4) == Approx(1.0 + 0.025 * std::log(1e4)));
    const solid::Material own = of_block("material = \"copper OFHC\"\nlaw = \"j2\"\nhardening = 1e8");
    CHECK(own.flow.power_hardening == 0.0);
    CHECK(own.flow.knows_rates());
    CHECK(of_block("material = \"copper OFHC\"").flow.power_hardening == 0.0);
    const WrittenScene written(two_blocks());
    const auto glass = input::check_scene(written.path(), {.set = {"bodies.left.material='glass soda-lime'",
                                                                   "bodies.left.law=j2", "bodies.left.kinematics=finite"}});
    REQUIRE(glass.faults.size() == 1);  // it breaks before it flows
    CHECK(glass.faults.front().text.find("yield_stress") != std::string::npos);
}

TEST_CASE("a body takes a table of hardening, with units, and its yield stress from the first row", "[input][materials]") {
    const solid::Material steel = of_block(
        "material = \"steel S235\"\nlaw = \"j2\"\nhardening_table = [[0, \"300 MPa\"], [\"2*0.05\", 4e8]]\n"
        "cowper_symonds_rate = 40.4\ncowper_symonds_exponent = 5");
    CHECK(steel.flow.yield_stress == 300e6);
    REQUIRE(steel.flow.table.size() == 2);
    CHECK(steel.flow.table[1].plastic_strain == 0.1);
    CHECK(steel.flow.table[1].stress == 4e8);
    CHECK(steel.flow.cowper_symonds_rate == 40.4);
    const WrittenScene written(two_blocks());
    const auto fault_of = [&](const std::string& table) {
        const auto checked =
            input::check_scene(written.path(), {.set = {"bodies.left.law=j2", "bodies.left.hardening_table=" + table}});
        REQUIRE_FALSE(checked.faults.empty());
        return input::text_of(checked.faults);
    };
    CHECK(fault_of("[0, 1]").find("a list of rows [plastic strain, stress in Pa]") != std::string::npos);
    CHECK(fault_of("[[0, 1, 2]]").find("a list of rows") != std::string::npos);
    CHECK(fault_of("[[0, '1 m']]").find("hardening_table, row 1") != std::string::npos);
    CHECK(fault_of("[[0, 2], [0.1, 1]]").find("must not fall") != std::string::npos);
}

TEST_CASE("a body takes the constants and axes of an orthotropic material, and a temperature that varies",
          "[input][materials]") {
    const std::string ply =
        "law = \"orthotropic\"\nyoung = \"140 GPa\"\nyoung_2 = \"10 GPa\"\nyoung_3 = 9e9\npoisson_13 = 0.3\npoisson_23 = "
        "0.45\n"
        "shear_12 = 5e9\nshear_13 = 5e9\nshear_23 = 3.4e9\ndensity = 1600\nthermal_expansion = -0.5e-6\nthermal_expansion_2 "
        "= 26e-6\n";
    const solid::Material plane = of_block(ply + "axis_angle = \"30 deg\"\ntemperature_rise = 1");
    CHECK(plane.law == solid::MaterialLaw::orthotropic);
    CHECK(plane.orthotropic.young_2 == 10e9);
    CHECK(plane.orthotropic.poisson_23 == 0.45);
    CHECK(plane.orthotropic.axis_angle == Approx(std::acos(-1.0) / 6.0));
    CHECK(plane.expansion.along_2 == 26e-6);
    const std::string block = "[bodies.block]\nshape = \"structured_box\"\n";
    const WrittenScene space(
        "dim = 3\n" + block + "lower = [0, 0, 0]\nupper = [1, 1, 1]\ncounts = [3, 3, 3]\n" + ply +
        "axis_1 = [0, 1, 1]\naxis_2 = [0, -1, 1]\ntemperature_rise = \"100*t + 20*x\"\n[run]\nsteps = 1\n");
    const auto scene = input::SceneFile(space.path()).scene<3>();
    CHECK(scene.solid.materials.front().orthotropic.axis_1 == std::array{0.0, 1.0, 1.0});
    CHECK(scene.solid.materials.front().orthotropic.axis_2 == std::array{0.0, -1.0, 1.0});
    REQUIRE(scene.solid.temperature_rise.size() == 1);
    CHECK(scene.solid.temperature_rise.front().varies);
    CHECK(scene.solid.temperature_rise.front().value(2.0, {0.5, 0.0, 0.0}) == 210.0);
    const auto fault_of = [&](const std::string& set) {
        const auto checked = input::check_scene(space.path(), {.set = {set}});
        REQUIRE_FALSE(checked.faults.empty());
        return input::text_of(checked.faults);
    };
    CHECK(fault_of("bodies.block.axis_2=[0, 1, 0]").find("cosine between axis_1 and axis_2") != std::string::npos);
    CHECK(fault_of("bodies.block.kinematics=rigid").find("temperature") != std::string::npos);
}

TEST_CASE("a material of the scene goes before the known one of its name", "[input][materials]") {
    const std::string table = "[materials.\"steel S235\"]\nyoung = 1e9\ndensity = 1000\n";
    const solid::Material own = of_block("material = \"steel S235\"", table);
    CHECK(own.young == 1e9);
    CHECK(own.density == 1000.0);
}

TEST_CASE("every known material has a source and values that a body may have", "[input][materials]") {
    for (const solid::KnownMaterial& known : solid::known_materials()) {
        CAPTURE(known.name);
        CHECK_FALSE(known.source.empty());
        const solid::Material material = of_block("material = \"" + known.name + "\"");
        CHECK(material.young == known.material.young);
        CHECK(material.density == known.material.density);
        CHECK(material.poisson == known.material.poisson);
        CHECK(known.flow.yield_stress < 0.03 * known.material.young);  // metals and plastics flow at some percent of strain
        CHECK(solid::known_material(known.name) == &known);
        if (known.flow.yield_stress > 0.0)
            CHECK(of_block("law = \"j2\"\nkinematics = \"finite\"\nmaterial = \"" + known.name + "\"").flow.yield_stress ==
                  known.flow.yield_stress);
    }
}

TEST_CASE("waves in known materials are as fast as handbooks of ultrasound have them", "[input][materials]") {
    struct Speeds {
        const char* name;
        double longitudinal, shear;  // [m/s], J. and H. Krautkraemer, Ultrasonic Testing of Materials, appendix
    };
    for (const auto& [name, longitudinal, shear] : {Speeds{"steel S235", 5920.0, 3255.0},
                                                    {"aluminium 6061-T6", 6320.0, 3130.0},
                                                    {"copper OFHC", 4700.0, 2260.0},
                                                    {"brass 70/30", 4430.0, 2120.0},
                                                    {"ice", 3980.0, 1990.0},
                                                    {"lead", 2160.0, 700.0}}) {
        CAPTURE(name);
        const solid::Material& material = solid::known_material(name)->material;
        CHECK(std::sqrt(material.wave_modulus() / material.density) == Approx(longitudinal).epsilon(0.05));
        CHECK(std::sqrt(material.mu() / material.density) == Approx(shear).epsilon(0.05));
    }
}
