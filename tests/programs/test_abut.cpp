#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/steps/simulation.hpp"
#include "programs/program.hpp"
#include "studies/scenes/two_cylinders.hpp"

namespace {

using namespace abut::test::programs;
namespace fs = std::filesystem;

std::string scene(const std::string& name) { return fmt::format("'{}/{}.toml'", ABUT_SCENES, name); }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("a scene gives the bits of the same scene made in C++", "[programs][abut]") {
    for (const auto& [name, offset] : {std::pair("slipping_cylinders", 0.8), std::pair("rebounding_cylinders", 0.0)}) {
        CAPTURE(name);
        const auto outcome = run_well("abut", fmt::format("run {} --frames 0", scene(name)), "of_scene");
        const auto summary = read_summary(outcome);
        const auto made = abut::studies::two_cylinders<2>({.offset = offset});
        const auto result = abut::run::simulate<2>(made, {});
        CHECK(summary["steps"] == result.run.steps);
        for (std::size_t body = 0; body < 2; ++body)
            for (int i = 0; i < 2; ++i)
                CHECK(summary["bodies"][body]["velocity_final"][i] == result.bodies.end[body].velocity[i]);
        CHECK(summary["complete"] == true);
        CHECK(summary["program"] == name);
        CHECK(summary["missed_contacts"] == 0);
    }
}

TEST_CASE("a value that a scene names changes all that its formulas say", "[programs][abut]") {
    const auto summary = read_summary(run_well("abut", slip("--set values.radius=2 --steps 1 --frames 0"), "named_values"));
    for (const auto& body : summary["bodies"])
        CHECK(body["mass"].get<double>() == Approx(4.0 * std::acos(-1.0)).epsilon(0.01));  // rho pi radius^2
    const auto coarse = read_summary(run_well("abut", slip("--steps 1 --frames 0"), "named_values"));
    CHECK(summary["cells"] == coarse["cells"]);  // their size follows the radius
}

TEST_CASE("options of the command line stand above values that are set, and these above the file", "[programs][abut]") {
    const auto run = [](const std::string& more) {
        return read_summary(
            run_well("abut", fmt::format("run {} --frames 0 {}", scene("slipping_cylinders"), more), "abut_options"));
    };
    const auto plain = run("--steps 4");  // in place of the time of the scene
    CHECK(plain["steps"] == 4);
    CHECK(plain["options"]["cfl"] == 0.9);
    const auto set = run("--steps 4 --set run.cfl=0.5 --set bodies.left.density=2");
    CHECK(set["options"]["cfl"] == 0.5);
    CHECK(set["kinetic_initial"].get<double>() == Approx(1.5 * plain["kinetic_initial"].get<double>()));
    const auto both = run("--steps 4 --set run.dt=1e-3 --cfl 0.25 --law pair_potential");
    CHECK(both["options"]["cfl"] == 0.25);
    CHECK(both["options"]["law"] == "pair_potential");
    CHECK(both["dt"].get<double>() > 1e-3);
    CHECK(run("--steps 4 --preset fast")["options"]["events"] == "off");
    CHECK(run("--time 0.2 --set run.steps=4")["steps"] > 4);
}

TEST_CASE("abut check estimates a run, says all that is wrong, and leaves no file", "[programs][abut]") {
    const auto good = run_program("abut", "check " + scene("slipping_cylinders") + " --cfl 0.5", "");
    CHECK(good.exit_code == 0);
    for (const char* word : {"no fault found", "bodies          2", "stable step", "steps"}) CHECK(has(good.out, word));
    const auto bad =
        run_program("abut", "check " + scene("slipping_cylinders") + " --set bodies.left.yuong=1 --set dim=5", "");
    CHECK(bad.exit_code == 1);
    for (const char* word : {"2 faults", "'young'", "dim is 5"}) CHECK(has(bad.error, word));
    CHECK(bad.out.empty());
}

TEST_CASE("abut run refuses what abut check refuses, and touches no file", "[programs][abut]") {
    const Folder folder("abut_refused");
    const auto out = folder.path() / "results";
    for (const char* wrong :
         {"--set bodies.left.yuong=1", "--set bodies.left.size=-1", "--set bodies.left", "--colour red"}) {
        CAPTURE(wrong);
        const auto outcome =
            run_program("abut", fmt::format("run {} {} --out '{}'", scene("slipping_cylinders"), wrong, out.string()), "");
        CHECK(outcome.exit_code == 1);
        CHECK(has(outcome.error, "abut"));
        CHECK_FALSE(fs::exists(out));
    }
    CHECK(run_program("abut", "run nowhere.toml", "").exit_code == 1);
    CHECK(run_program("abut", "", "").exit_code == 1);
}

TEST_CASE("a command or an option that is none is answered with the nearest one, and a key of the laboratory with --lab",
          "[programs][abut]") {
    const auto error_of = [](const std::string& words) { return run_program("abut", words, "").error; };
    CHECK(has(error_of("rnu ball.toml"), "'rnu' is no command. Did you mean run?"));
    CHECK(has(error_of("ball.toml"), "'ball.toml' is no command. Commands are run, check, "));
    CHECK(has(error_of(""), "a command is missing: one of run, check, "));
    CHECK(
        has(error_of("run ball.toml --frictoin 0.3"), "--frictoin: abut run has no such option. Did you mean --friction?"));
    CHECK(has(error_of("run ball.toml --free-faces=adjacent"),
              "--free-faces: abut run has no such option. It compares "
              "methods: --lab free_faces=VALUE."));
    CHECK(has(error_of("run " + scene("slipping_cylinders") + " --lab overlap=exac"),
              "--lab overlap=exac: 'exac' is not known; choose one of moving, frozen."));
}

TEST_CASE("a sweep runs all combinations, and its table says what became of each", "[programs][abut]") {
    const Folder folder("abut_sweep");
    const auto out = folder.path() / "sweep";
    const auto outcome = run_program("abut",
                                     fmt::format("run {} --steps 3 --frames 0 --out '{}' --sweep bodies.left.density=1,-2,3 "
                                                 "--sweep \"bodies.left.velocity=[0.05,0],[1e200,0]\"",
                                                 scene("slipping_cylinders"), out.string()),
                                     "");
    CHECK(outcome.exit_code == 1);
    CHECK(has(outcome.error, "4 of 6 runs did not end"));
    std::ifstream table(out / "sweep.csv");
    std::vector<std::string> lines;
    for (std::string line; std::getline(table, line);) lines.push_back(line);
    REQUIRE(lines.size() == 7);
    CHECK(has(lines[0], "folder,\"bodies.left.density\",\"bodies.left.velocity\",state,"));
    CHECK(has(lines[1], "run_1,\"1\",\"[0.05,0]\",held,"));
    CHECK(has(lines[2], "run_2,\"1\",\"[1e200,0]\","));
    CHECK_FALSE(has(lines[2], "held"));
    CHECK(has(lines[3], "run_3,\"-2\",\"[0.05,0]\",refused,"));
    CHECK(has(lines[3], "bodies.left.density is -2 kg/m^3"));
    CHECK(has(lines[5], "run_5,\"3\",\"[0.05,0]\",held,"));
    for (const char* run : {"run_1", "run_5"}) CHECK(fs::exists(out / run / "summary.json"));
    for (const char* run : {"run_2", "run_3"}) CHECK_FALSE(fs::exists(out / run / "summary.json"));
    const auto wrong = [&](const std::string& sweeps) {
        return run_program("abut", fmt::format("run {} --out '{}' {}", scene("slipping_cylinders"), out.string(), sweeps),
                           "");
    };
    CHECK(wrong("--sweep bodies.left.density=-1").exit_code == 1);
    CHECK_FALSE(fs::exists(out / "run_1" / "summary.json"));  // that of the sweep before is gone
    CHECK(has(wrong("--sweep bodies.left.density").error, "a key and its values"));
    CHECK(has(wrong("--sweep bodies.left.density=1,,2").error, "a key and its values"));
    CHECK(has(wrong("--sweep run.cfl=0.5 --sweep run.cfl=0.4").error, "given twice"));
}

TEST_CASE("a scene is found without its ending", "[programs][abut]") {
    const Folder folder("abut_without_ending");
    const std::string name = (folder.path() / "ball").string();
    REQUIRE(run_program("abut", fmt::format("new '{}'", name), "").exit_code == 0);
    const auto outcome = run_program("abut", fmt::format("check '{}'", name), "");
    CHECK(outcome.exit_code == 0);
    CHECK(has(outcome.out, "ball.toml: no fault found"));
}

TEST_CASE("abut new writes a scene that has no fault and runs, and no file twice", "[programs][abut]") {
    const Folder folder("abut_new");
    const auto file = folder.path() / "mine.toml";
    const auto written = run_program("abut", fmt::format("new '{}'", (folder.path() / "mine").string()), "");
    CHECK(written.exit_code == 0);
    CHECK(has(written.out, "abut check"));
    REQUIRE(fs::exists(file));
    const auto again = run_program("abut", fmt::format("new '{}'", file.string()), "");
    CHECK(again.exit_code == 1);
    CHECK(has(again.error, "there already"));
    const auto checked = run_program("abut", fmt::format("check '{}'", file.string()), "");
    CHECK(checked.exit_code == 0);
    const auto run = run_well("abut", fmt::format("run '{}' --frames 2", file.string()), "abut_new_results");
    CHECK(relative_drift(run) < 1e-11);
    CHECK(read_summary(run)["missed_contacts"] == 0);
    CHECK(read_summary(run)["active_pairs_max"] > 0);  // something does happen in it
}

TEST_CASE("abut says its version, its commands and all keys of a scene", "[programs][abut]") {
    CHECK(has(run_program("abut", "--version", "").out, "abut 0."));
    const auto help = run_program("abut", "--help", "");
    CHECK(help.exit_code == 0);
    for (const char* command : {"run", "check", "new", "keys", "materials", "Exit codes"}) CHECK(has(help.out, command));
    const auto of_run = run_program("abut", "run --help", "");
    CHECK(of_run.exit_code == 0);
    for (const char* option : {"--set", "--cfl", "--out", "--preset", "--law"}) CHECK(has(of_run.out, option));
    CHECK(has(run_program("abut", "keys", "").out, "| `young` | number | Pa |"));
    CHECK(has(run_program("abut", "materials", "").out, "| `steel S235` | 210 GPa | 0.3 | 7850 kg/m^3 | 235 MPa |"));
}
