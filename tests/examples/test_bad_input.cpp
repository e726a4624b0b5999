#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "examples/program.hpp"

namespace {

using namespace abut::examples::test;

/// Arguments that must be refused, and what the message must name: place, value, limit, remedy.
struct BadInput {
    const char* arguments;
    std::vector<std::string> words;
};

const std::vector<BadInput> bad_options = {
    {"--broad-phase bvh", {"--broad-phase", "bvh", "embree", "fcl", "brute_force", "--help"}},
    {"--overlap sliding", {"--overlap", "sliding", "moving", "frozen"}},
    {"--neumann free", {"--neumann", "free", "local_equilibrium"}},
    {"--events maybe", {"--events", "maybe", "on", "off"}},
    {"--quadrature 4", {"--quadrature", "4", "1, 2, 3"}},
    {"--dim 4", {"--dim", "4", "2, 3"}},
    {"--colour red", {"--colour", "--help"}},
    {"--density nan", {"--density", "nan", "above 0 kg/m^3"}},
    {"--density -1", {"--density", "-1 kg/m^3", "above 0 kg/m^3"}},
    {"--density 1,-2", {"--density", "-2 kg/m^3", "above 0 kg/m^3"}},
    {"--density 1,2,3", {"--density", "1,2,3", "two"}},
    {"--density heavy", {"--density", "heavy", "above 0 kg/m^3"}},
    {"--poisson 0.5", {"--poisson", "0.5", "below 0.5", "take 0.49"}},
    {"--poisson -1", {"--poisson", "-1", "above -1"}},
    {"--poisson inf", {"--poisson", "inf", "finite"}},
    {"--young 0", {"--young", "0 Pa", "above 0 Pa"}},
    {"--young -5,1", {"--young", "-5 Pa", "above 0 Pa"}},
    {"--eta -1", {"--eta", "-1 Pa", "not below 0 Pa"}},
    {"--radius 0", {"--radius", "0 m", "above 0 m"}},
    {"--speed -0.1", {"--speed", "-0.1 m/s", "not below 0 m/s"}},
    {"--speed 0", {"--speed", "0 m/s", "never meet"}},
    {"--time -1", {"--time", "-1 s", "above 0 s"}},
    {"--interval -1", {"--interval", "-1", "at least 0"}},
    {"--threads many", {"--threads", "many", "whole number"}},
    {"--cfl 1.5", {"--cfl", "1.5", "not above 1", "--allow-unstable"}},
    {"--cfl 0", {"--cfl", "0", "above 0"}},
    {"--dt 1", {"--dt", "1 s", "stable step of 0.0", "--allow-unstable"}},
    {"--allow-unstable", {"--allow-unstable", "--dt"}},
    {"--size 2", {"--size", "2 m", "1 m", "tenth"}},
    {"--offset 2.5", {"--offset", "2.5 m", "2 m", "Lower"}},
    {"--gap -0.1", {"'left'", "'right'", "overlap", "cells", "m inside each other", "0 m is allowed", "Raise --gap", "-0.1 m"}},
    {"--dim 3 --size 0.3 --gap -0.2", {"'left'", "'right'", "overlap", "Raise --gap"}},
    {"--mesh left.msh", {"--mesh", "2"}},
    {"--mesh left.msh,right.msh --radius 2", {"--mesh", "--radius"}},
    {"--mesh nowhere.msh,right.msh", {"nowhere.msh", "no such file", "path"}},
};

void check_refused(const BadInput& bad, const Outcome& outcome) {
    INFO(bad.arguments << "\n" << outcome.error);
    CHECK(outcome.exit_code != 0);
    for (const std::string& word : bad.words) CHECK(outcome.error.find(word) != std::string::npos);
    CHECK(std::ranges::count(outcome.error, '\n') == 1);  // one message
    CHECK(outcome.error.find("terminate") == std::string::npos);
    for (const char* file : {"summary.json", "energy.csv", "energy.png"}) CHECK_FALSE(std::filesystem::exists(outcome.directory / file));
}

}  // namespace

TEST_CASE("bad options end with one message that names them, and leave no result", "[examples]") {
    const BadInput bad = GENERATE(from_range(bad_options));
    const auto outcome = run_program("slipping_cylinders", bad.arguments, "bad_option");
    check_refused(bad, outcome);
    std::filesystem::remove_all(outcome.directory);
}

TEST_CASE("a run that breaks off says at which step, and leaves no result", "[examples]") {
    const BadInput bad = GENERATE(
        BadInput{"--gap 10 --dt 0.05 --allow-unstable --frames 0", {"step ", "diverged", "H~", "0.05 s", "stable", "--dt", "energy.csv.partial"}},
        BadInput{"--speed 5 --frames 0", {"step ", "faces", "2.0", "allowed", "speed"}});
    const auto outcome = run_program("slipping_cylinders", bad.arguments, "broken_off");
    check_refused(bad, outcome);
    CHECK(std::filesystem::exists(outcome.directory / "energy.csv.partial"));
    std::filesystem::remove_all(outcome.directory);
}

TEST_CASE("an output folder that cannot be written to is refused before the run", "[examples]") {
    const auto good = run_well("slipping_cylinders", "--size 0.25 --frames 0", "in_the_way");
    const std::string file = (good.directory / "summary.json").string();
    const BadInput bad = {"", {"--out", file, "cannot be written to", "Choose another folder"}};
    check_refused(bad, run_program("slipping_cylinders", "--size 0.25 --out '" + file + "'", ""));
    std::filesystem::remove_all(good.directory);
}

TEST_CASE("a bad run leaves no results of an earlier good one beside its own", "[examples]") {
    const auto good = run_well("slipping_cylinders", "--size 0.25 --frames 0", "twice");
    const std::string same_folder = " --out '" + good.directory.string() + "'";
    Outcome bad = run_program("slipping_cylinders", "--gap 10 --dt 0.1 --allow-unstable --frames 0" + same_folder, "");
    bad.directory = good.directory;
    check_refused({"diverges into the folder of a good run", {"diverged"}}, bad);
    std::filesystem::remove_all(good.directory);
}

TEST_CASE("mesh files that cannot be used are refused by name", "[examples]") {
    const auto folder = std::filesystem::path(ABUT_EXAMPLE_RESULTS) / "meshes";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "empty.msh");
    std::ofstream(folder / "truncated.msh") << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 3\n";
    const std::string name = GENERATE("empty.msh", "truncated.msh");
    const std::string path = (folder / name).string();
    const auto outcome = run_program("slipping_cylinders", "--mesh '" + path + "','" + path + "'", "bad_mesh");
    check_refused({name.c_str(), {path}}, outcome);
    std::filesystem::remove_all(outcome.directory);
}
