#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "programs/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace abut::test::programs;

/// Arguments that must be refused, and what the message must name: place, value, limit, remedy.
struct Refusal {
    std::string arguments;
    std::vector<std::string> words;
};

const std::vector<Refusal> bad_options = {
    {"--lab broad_phase=bvh", {"--lab broad_phase", "bvh", "embree", "fcl", "brute_force"}},
    {"--lab overlap=sliding", {"--lab overlap", "sliding", "moving", "frozen"}},
    {"--lab free_faces=free", {"--lab free_faces", "free", "local_equilibrium"}},
    {"--lab events=maybe", {"--lab events", "maybe", "on", "off"}},
    {"--lab quadrature=4", {"--lab quadrature", "4", "from 0 to 3"}},
    {"--lab quadrature", {"--lab", "'quadrature'", "no KEY=VALUE", "quadrature"}},
    {"--lab friction=0.3", {"--lab", "'friction=0.3'", "overlap"}},
    {"--overlap frozen", {"--overlap", "--help"}},
    {"--colour red", {"--colour", "--help"}},
    {"--time -1", {"--time", "-1 s", "above 0 s"}},
    {"--steps -1", {"--steps", "-1", "at least 0"}},
    {"--steps 10 --time 1", {"--steps", "excludes", "--time"}},
    {"--interval -1", {"--interval", "-1", "at least 0"}},
    {"--threads many", {"--threads", "many", "whole number"}},
    {"--compression-limit 0", {"--compression-limit", "0", "above 0"}},
    {"--cfl 1.5", {"--cfl", "1.5", "not above 1", "--allow-unstable"}},
    {"--cfl 0", {"--cfl", "0", "above 0"}},
    {"--dt 1", {"--dt", "1 s", "stable step of 0.0", "--allow-unstable"}},
    {"--dt 0.01 --cfl 0.5", {"--dt", "excludes", "--cfl"}},
    {"--allow-unstable", {"--allow-unstable", "--dt"}},
    {"--integrator rk4", {"--integrator", "rk4", "memm, memm_async, leapfrog, bilbao"}},
    {"--integrator leapfrog --filter neutral", {"--filter", "leapfrog", "--filter none"}},
    {"--integrator bilbao --restart 50", {"--restart", "bilbao", "memm"}},
    {"--restart -1", {"--restart", "'-1'", "at least 0"}},
    {"--lab gauge=1", {"laboratory.gauge", "is for bilbao, and memm was chosen", "--integrator bilbao"}},
    {"--lab precision=half", {"--lab precision", "half", "double, single"}},
    {"--lab precision=single --integrator bilbao", {"laboratory.precision", "bilbao", "--lab precision=double"}},
    {"--lab precision=single --integrator memm_async", {"laboratory.precision", "memm_async", "--lab precision=double"}},
    {"--law automatic --lab precision=single --kinematics finite",
     {"kinematics \"finite\"", "single precision", "--lab precision=double"}},
    {"--device gpu", {"--device", "gpu", "host, kokkos"}},
    {"--device kokkos --integrator bilbao", {"--device", "bilbao", "--device host"}},
    {"--law automatic --device kokkos --kinematics finite", {"kinematics \"finite\"", "on a device", "--device host"}},
    {"--lab gauge=0 --integrator bilbao", {"--lab gauge", "0 J", "above 0 J"}},
    {"--lab levels=3", {"laboratory.levels", "is for memm_async, and memm was chosen", "--integrator memm_async"}},
    {"--lab levels=99 --integrator memm_async", {"99 levels", "1 to 20"}},
    {"--set values.gap=-0.1",
     {"'left'", "'right'", "overlap", "cells", "m inside each other", "0 m is allowed", "with place"}},
    {"--time 1e300", {"--time", "1e+300 s", "steps", "1 to 1e+15 are allowed", "--dt"}},
    {"--dt 1e-300", {"--time", "steps of 1e-300 s", "1 to 1e+15 are allowed", "--dt"}},
    {"--steps 1e3", {"--steps", "1e3", "whole number"}},
};

const std::vector<Refusal> bad_options_of_the_strip = {
    {"--cells 3", {"--cells", "3", "at least 4"}},
    {"--filter weak", {"--filter", "weak", "none, neutral"}},
    {"--eta nan", {"--eta", "nan", "finite", "not below 0 Pa"}},
    {"--dt 0.0024", {"--dt", "0.0024 s", "stable step of 0.0022", "--allow-unstable"}},
    {"--csv energy.csv", {"--csv", "--help"}},
};

const std::vector<std::pair<std::string, Refusal>> bad_options_of_comparisons = {
    {"study orders", {"--halvings 30", {"--halvings: 30", "at most 12"}}},
    {"study fpu",
     {"--integrator euler", {"--integrator", "euler", "all, memm, leapfrog, bilbao, energy_momentum, memm_async"}}},
    {"study fpu", {"--mean 4", {"--mean", "4", "system, 1, 2, 3"}}},
    {"study fpu", {"--dt 0", {"--dt", "0 s", "above 0 s"}}},
    {"study fpu", {"--dt 1e-300", {"steps of 1e-300 s", "1 to 1e+15 are allowed"}}},
    {"study fpu", {"--gauge 1 --integrator memm", {"--gauge", "memm does not know it", "--integrator bilbao"}}},
    {"study fpu", {"--mean 2 --integrator leapfrog", {"--mean", "leapfrog does not know it", "memm or energy_momentum"}}},
    {"study fpu", {"--fast 7", {"--fast", "7 masses", "there are 6"}}},
    {"study fpu", {"--parts 0", {"--parts", "'0'", "at least 1"}}},
    {"study fpu", {"--start half --integrator energy_momentum", {"--start", "energy_momentum does not know it"}}},
    {"study fpu", {"--omega nan", {"--omega", "nan", "finite"}}},
    {"study slow_fast_wave", {"--integrator bilbao", {"--integrator", "bilbao", "all, memm, memm_async, leapfrog"}}},
    {"study slow_fast_wave", {"--time 0.6", {"--time", "0.6 s", "not above 0.5 s"}}},
    {"study slow_fast_wave", {"--cells 1001 --refinements 0", {"--cells", "1001", "even", "interface"}}},
    {"study slow_fast_wave", {"--cells 1002", {"--cells", "1002 halved 2 times", "multiple of 16", "--refinements"}}},
    {"study slow_fast_wave", {"--cfl 1.01", {"--cfl", "1.01", "not above 1", "unstable"}}},
    {"study slow_fast_wave", {"--ratio 20", {"--ratio", "20 steps", "below 1 is stable", "--cfl"}}},
    {"study slow_fast_wave", {"--ratio 5 --integrator memm", {"--ratio", "memm does not know it"}}},
    {"study bouncing_bar", {"--gravity 5", {"--gravity", "5", "0, 10"}}},
    {"study bouncing_bar", {"--cells 3", {"--cells", "3", "at least 4"}}},
    {"study bouncing_bar", {"--cfl 2", {"--cfl", "2", "not above 1"}}},
    {"study bouncing_bar", {"--filter weak", {"--filter", "weak", "none, neutral"}}},
    {"study bouncing_bar", {"--filter neutral --integrator leapfrog", {"--filter", "leapfrog does not know it"}}},
    {"study bouncing_bar", {"--filter neutral --patch 1", {"--patch", "'1'", "at least 2"}}},
    {"study bouncing_bar", {"--patch 3", {"--patch", "--filter"}}},
    {"study bouncing_bar", {"--cells 10 --filter neutral --patch 11", {"--patch", "11 masses", "the bar has 10"}}},
    {"study bouncing_bar", {"--gauge 0", {"Bilbao scheme", "Raise the gauge"}}},
};

void check_no_result(const fs::path& directory) {
    REQUIRE_FALSE(directory.empty());
    for (const char* file : {"summary.json", "energy.csv", "energy.svg"}) CHECK_FALSE(fs::exists(directory / file));
}

void check_refused(const Refusal& bad, const Outcome& outcome) {
    INFO(bad.arguments << "\n" << outcome.error);
    CHECK(outcome.exit_code == 1);
    for (const std::string& word : bad.words) {
        INFO("does it say '" << word << "'?");
        CHECK(outcome.error.find(word) != std::string::npos);
    }
    CHECK(std::ranges::count(outcome.error, '\n') == 1);  // one message
    check_no_result(outcome.directory);
}

/// An ASCII file of Gmsh's format 2.2: nodes "x y z", elements "type, nodes", numbered from 1, one body.
void write_msh(const fs::path& path, const std::vector<std::string>& nodes, const std::vector<std::string>& elements) {
    std::ofstream file(path);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << nodes.size() << "\n";
    for (std::size_t i = 0; i < nodes.size(); ++i) file << i + 1 << " " << nodes[i] << "\n";
    file << "$EndNodes\n$Elements\n" << elements.size() << "\n";
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto blank = elements[i].find(' ');
        file << i + 1 << " " << elements[i].substr(0, blank) << " 2 1 1" << elements[i].substr(blank) << "\n";
    }
    file << "$EndElements\n";
}

struct BadMesh {
    std::string name;
    int dim;
    std::vector<std::string> nodes;
    std::vector<std::string> elements;
    std::vector<std::string> words;
};

// Element types of Gmsh: 2 triangle, 3 quadrangle, 4 tetrahedron, 5 hexahedron.
const std::vector<BadMesh> bad_meshes = {
    {"flat_triangle",
     2,
     {"0 0 0", "1 0 0", "0 1 0", "0 2 0"},
     {"2 1 2 3", "2 1 3 4"},
     {"cell 2 (triangle) is flat", "its measure is 0 m^2", "more than", "is needed", "mesh the part again"}},
    {"no_edge",
     2,
     {"0 0 0", "1 0 0", "1 1 0", "1 1 0"},
     {"3 1 2 3 4"},
     {"face (3, 4) of cell 1 is degenerate", "its measure is 0 m^1", "more than", "is needed", "Merge"}},
    {"flat_tetrahedron",
     3,
     {"0 0 0", "1 0 0", "0 1 0", "1 1 0"},
     {"4 1 2 3 4"},
     {"cell 1 (tetrahedron) is flat", "its measure is 0 m^3", "more than", "is needed", "mesh the part again"}},
    {"no_face",
     3,
     {"0 0 0", "1 0 0", "0.5 1 0", "0.5 1 0", "0 0 1", "1 0 1", "0.5 1 1", "0.5 1 1"},
     {"5 1 2 3 4 5 6 7 8"},
     {"face (", "of cell 1 is degenerate", "its measure is 0 m^2", "more than", "is needed", "Merge"}},
};

/// Into a folder that is there already.
Outcome run_into(const fs::path& directory, const std::string& program, const std::string& arguments) {
    Outcome outcome = run_program(program, fmt::format("{} --out '{}'", arguments, directory.string()), "");
    outcome.directory = directory;
    return outcome;
}

std::string with_mesh(int dim, const fs::path& path) {
    const fs::path scene = path.parent_path() / "one_mesh.toml";
    std::ofstream(scene) << fmt::format(
        "dim = {}\n[materials.one]\nyoung = 1\ndensity = 1\n[bodies.one]\nmesh = '{}'\nmaterial = \"one\"\n", dim,
        path.string());
    return fmt::format("run '{}' --time 1", scene.string());
}

}  // namespace

TEST_CASE("bad options end with one message that names them, and leave no result", "[programs]") {
    const Refusal bad = GENERATE(from_range(bad_options));
    check_refused(bad, run_program("abut", slip(bad.arguments), "bad_option"));
}

TEST_CASE("bodies of a scene in 3D that overlap end in the same way", "[programs]") {
    const Refusal bad{"--set values.size=0.3 --set values.gap=-0.2", {"'left'", "'right'", "overlap", "with place"}};
    check_refused(bad, run_program("abut", slip_3d(bad.arguments), "bad_3d"));
}

TEST_CASE("bad options of the bouncing strip end in the same way", "[programs]") {
    const Refusal bad = GENERATE(from_range(bad_options_of_the_strip));
    check_refused(bad, run_program("study bouncing_strip", bad.arguments, "bad_strip_option"));
}

TEST_CASE("bad options of the programs that compare integrators end in the same way", "[programs]") {
    const auto [program, bad] = GENERATE(from_range(bad_options_of_comparisons));
    check_refused(bad, run_program(program, bad.arguments, "bad_comparison_option"));
}

TEST_CASE("a run that breaks off says at which step, and leaves no result", "[programs]") {
    const Refusal bad = GENERATE(Refusal{"--set values.gap=10 --dt 0.05 --allow-unstable --interval 1 --frames 0",
                                         {"step ", "diverged", "H~", "0.05 s", "stable", "--dt", "Worst is cell ",
                                          "of body '", "energy.csv.partial", "bodies_failed.pvd"}},
                                 Refusal{"--set values.speed=5 --frames 0",
                                         {"step 1", "face ", "(body 0, at (", "2 is allowed", "compression_limit",
                                          "lower the speed", "energy.csv.partial", "bodies_failed.pvd"}});
    const auto outcome = run_program("abut", slip(bad.arguments), "broken_off");
    check_refused(bad, outcome);
    for (const char* name : {"energy.csv.partial", "failed.csv", "bodies_failed.pvd", "frames/bodies_failed_000000.vtu"})
        CHECK(fs::exists(outcome.directory / name));
}

TEST_CASE("an output folder with a file in its place is refused before the run", "[programs]") {
    const auto [program, arguments] = GENERATE(table<std::string, std::string>({{"abut", slip("")},
                                                                                {"study bouncing_strip", ""},
                                                                                {"study bouncing_bar", ""},
                                                                                {"study fpu", ""},
                                                                                {"study slow_fast_wave", ""}}));
    const Folder folder("in_the_way");
    const std::string file = (folder.path() / "results").string();
    std::ofstream(file) << "something\n";
    const Refusal bad = {"", {"--out", file, "cannot be written to", "a file is in its place", "Choose another folder"}};
    check_refused(bad, run_into(file, program, arguments));
    CHECK(read_text(file) == "something\n");
}

TEST_CASE("an output folder that cannot exist is refused before the run", "[programs]") {
    const Folder folder("no_name");
    const std::string out = (folder.path() / std::string(300, 'x')).string();
    Outcome outcome = run_into(out, "abut", slip(""));
    outcome.directory = folder.path();
    check_refused({"", {"--out", "cannot be written to", "File name too long", "Choose another folder"}}, outcome);
}

TEST_CASE("an output folder without permission to write is refused before the run", "[programs]") {
    const Folder folder("read_only");
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    if (access(folder.path().c_str(), W_OK) == 0) {
        WARN("skipped: whoever runs this may write to any folder");
        return;
    }
    const std::string out = folder.path().string();
    const Refusal bad = {"", {"--out", out, "cannot be written to", "Permission denied", "Choose another folder"}};
    check_refused(bad, run_into(out, "abut", slip("")));
    fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST_CASE("an output folder with a link in the place of its lock is refused before the run", "[programs]") {
    const Folder folder("linked");
    fs::create_symlink("/dev/null", folder.path() / ".abut.lock");
    const std::string out = folder.path().string();
    const Refusal bad = {"", {"--out", out, "cannot be written to", "a link", ".abut.lock", "Choose another folder"}};
    check_refused(bad, run_into(out, "abut", slip("")));
}

TEST_CASE("a disc that fills up during a run ends it with a message, and leaves no result", "[programs]") {
    const auto outcome =
        run_program("abut", slip("--set values.size=0.25 --frames 0"), "fills_up", "trap '' XFSZ; ulimit -f 16;");
    check_refused({"", {"energy.csv.partial", "cannot be written", "free space"}}, outcome);
}

TEST_CASE("a bad run leaves no results of an earlier good one, and nobody else's file is touched", "[programs]") {
    const Refusal bad = GENERATE(Refusal{"--dt 1", {"--dt"}}, Refusal{"--set values.gap=-0.1", {"overlap"}},
                                 Refusal{"--set values.gap=10 --dt 0.1 --allow-unstable --frames 0", {"diverged"}});
    const auto good = run_well("abut", slip("--set values.size=0.25 --steps 4 --frames 2"), "twice");
    REQUIRE(fs::exists(good.directory / "frames/bodies_surface_000001.vtp"));
    const std::vector<std::string> mine = {"bodies_2.vtu", "frames/bodies_new_000001.vtu", "frames/otherbodies_000001.vtu",
                                           "notes.txt"};
    for (const auto& name : mine) std::ofstream(good.directory / name) << "mine\n";
    check_refused(bad, run_into(good.directory, "abut", slip(bad.arguments)));
    auto left = files_in(good.directory);
    std::erase_if(left, [](const std::string& name) {  // of the bad run
        return name == "energy.csv.partial" || name.starts_with("failed.") ||
               name.find("bodies_failed") != std::string::npos;
    });
    CHECK(left == mine);
}

TEST_CASE("a scene that cannot be read leaves the results of an earlier run, and the message names them", "[programs]") {
    const auto good = run_well("abut", slip("--set values.size=0.25 --steps 4 --frames 2"), "unread");
    const auto before = files_in(good.directory);
    const auto bad = run_into(good.directory, "abut", slip("--set bodies.left.yuong=1"));
    CHECK(bad.exit_code == 1);
    CHECK_THAT(bad.error, Catch::Contains("yuong") &&
                              Catch::EndsWith(good.directory.string() + " still has the results of an earlier run.\n"));
    CHECK(files_in(good.directory) == before);
}

TEST_CASE("a run of few frames leaves none of an earlier run of many", "[programs]") {
    const auto many = run_well("abut", slip("--set values.size=0.25 --steps 8 --frames 5"), "frames_again");
    REQUIRE(run_into(many.directory, "abut", slip("--set values.size=0.25 --steps 8 --frames 2")).exit_code == 0);
    const auto frames = [&](const std::string& ending) {
        return std::ranges::count_if(files_in(many.directory), [&](const auto& name) { return name.ends_with(ending); });
    };
    CHECK(frames(".vtu") == 2);
    CHECK(frames(".vtp") == 4);  // of the surface and of pairs in contact
}

TEST_CASE("mesh files that cannot be read are refused by name", "[programs]") {
    const Folder meshes("meshes");
    std::ofstream(meshes.path() / "empty.msh");
    std::ofstream(meshes.path() / "truncated.msh") << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 3 1 3\n";
    const auto [name, words] = GENERATE(table<std::string, std::vector<std::string>>(
        {{"empty.msh", {"empty", "0 bytes", "again"}}, {"truncated.msh", {"$EndNodes", "again"}}}));
    const auto path = meshes.path() / name;
    Refusal bad{with_mesh(2, path), words};
    bad.words.push_back(path.string());
    check_refused(bad, run_program("abut", bad.arguments, "bad_mesh"));
}

TEST_CASE("meshes with inverted or flat cells or degenerate faces are refused with cell, measure, limit and remedy",
          "[programs]") {
    const BadMesh bad = GENERATE(from_range(bad_meshes));
    const Folder meshes("bad_meshes");
    const auto path = meshes.path() / (bad.name + ".msh");
    write_msh(path, bad.nodes, bad.elements);
    const Refusal input{with_mesh(bad.dim, path), bad.words};
    check_refused(input, run_program("abut", input.arguments, "bad_cells"));
}
