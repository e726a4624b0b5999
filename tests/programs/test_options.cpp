#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

const std::string coarse = "--set values.size=0.25 --frames 0 ";

Outcome run_coarse(const std::string& more, const std::string& folder, int dim = 2) {
    return run_well("abut", dim == 2 ? slip(coarse + more) : slip_3d(coarse + more), folder);
}

/// "--set" of a key of both bodies.
std::string set_both(const std::string& key, double left, double right) {
    return fmt::format("--set bodies.left.{0}={1} --set bodies.right.{0}={2} ", key, left, right);
}

/// A square of n x n squares with its lower left corner at (x, y), as ASCII Gmsh 2.2.
void write_square(const std::filesystem::path& path, double x, double y, double side, int n) {
    std::ofstream file(path);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << (n + 1) * (n + 1) << "\n";
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            file << fmt::format("{} {:.17g} {:.17g} 0\n", j * (n + 1) + i + 1, x + side * i / n, y + side * j / n);
    file << "$EndNodes\n$Elements\n" << n * n << "\n";
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int corner = j * (n + 1) + i + 1;
            file << fmt::format("{} 3 2 1 1 {} {} {} {}\n", j * n + i + 1, corner, corner + 1, corner + n + 2,
                                corner + n + 1);
        }
    file << "$EndElements\n";
}

}  // namespace

TEST_CASE("the energy holds to round-off for every choice that is exact", "[programs]") {
    const auto [dim, choice] =
        GENERATE(table<int, std::string>({{2, ""},
                                          {2, "--lab weighting=half"},
                                          {2, "--lab area=exact"},
                                          {2, "--lab free_faces=extrapolate"},
                                          {2, "--lab free_faces=adjacent"},
                                          {2, set_both("eta", 0.5, 0.5)},
                                          {2, set_both("eta", 0.5, 2.0)},
                                          {2, set_both("poisson", 0.0, 0.45)},
                                          {2, "--cfl 0.4"},
                                          {2, "--skin 0.3"},
                                          {2, "--set values.offset=0.3"},
                                          {2, "--lab quadrature=3"},
                                          {2, "--filter neutral"},
                                          {2, set_both("young", 1.0, 100.0) + set_both("density", 1.0, 10.0)},
                                          {3, "--set bodies.left.length=0.6"},
                                          {3, "--lab corners=fixed"}}));
    CAPTURE(dim, choice);
    const auto outcome = run_coarse(choice, "choice", dim);
    const auto summary = read_summary(outcome);
    CHECK(relative_drift(outcome) <= 1e-11);
    CHECK(summary["events"] > 0);
    CHECK(summary["missed_contacts"] == 0);
    CHECK(summary["active_pairs_max"] > 0);
}

TEST_CASE("a frozen overlap does not keep the energy", "[programs]") {
    const auto moving = run_coarse("--lab overlap=moving", "moving");
    const auto frozen = run_coarse("--lab overlap=frozen", "frozen");
    CHECK(relative_drift(frozen) >= 1e3 * relative_drift(moving));
    CHECK(relative_drift(frozen) >= 1e-9);
    CHECK(read_summary(frozen)["options"]["overlap"] == "frozen");
}

TEST_CASE("each choice of the method changes the motion", "[programs]") {
    // unequal bodies: between equal ones the weights are halves
    const std::string bodies = set_both("young", 1.0, 5.0);
    const auto velocity = [&](const std::string& choice, const std::string& folder) {
        return read_summary(run_coarse(bodies + choice, folder))["bodies"][0]["velocity_final"];
    };
    const auto by_default = velocity("", "default_choice");
    for (const std::string& choice :
         {std::string("--lab weighting=half"), std::string("--lab free_faces=extrapolate"),
          std::string("--lab free_faces=adjacent"), set_both("eta", 0.5, 0.5), set_both("poisson", 0.1, 0.1)}) {
        CAPTURE(choice);
        CHECK(velocity(choice, "other_choice") != by_default);
    }
}

TEST_CASE("what free faces do beside one in contact changes the motion of bodies with edges", "[programs]") {
    const auto relaxed = run_coarse("", "relaxed", 3), fixed = run_coarse("--lab corners=fixed", "fixed", 3);
    CHECK(read_summary(fixed)["options"]["corners"] == "fixed");
    CHECK(read_summary(fixed)["bodies"][0]["velocity_final"] != read_summary(relaxed)["bodies"][0]["velocity_final"]);
}

TEST_CASE("the options --cfl, --dt, --time and --steps say how long steps and the run are, and the summary what was used",
          "[programs]") {
    const auto outcome = run_coarse("--cfl 0.5 --time 1.5", "cfl");
    const auto by_cfl = read_summary(outcome);
    const double dt = by_cfl["dt"].get<double>();
    CHECK(dt == Approx(0.5 * by_cfl["stable_dt"].get<double>()).epsilon(1e-14));
    CHECK(by_cfl["dt_over_stable_dt"].get<double>() == Approx(0.5).epsilon(1e-14));
    CHECK(by_cfl["options"]["cfl"] == 0.5);
    CHECK_FALSE(by_cfl["options"].contains("dt"));
    CHECK(by_cfl["options"]["time"] == 1.5);
    CHECK(by_cfl["time"].get<double>() >= 1.5 * (1.0 - 1e-12));
    CHECK(by_cfl["time"].get<double>() < 1.5 + dt);

    const auto by_dt = read_summary(run_coarse("--dt 0.02 --steps 007", "dt"));  // decimal
    CHECK(by_dt["dt"] == 0.02);
    CHECK(by_dt["dt_over_stable_dt"].get<double>() == Approx(0.02 / by_dt["stable_dt"].get<double>()));
    CHECK(by_dt["options"]["dt"] == 0.02);
    CHECK_FALSE(by_dt["options"].contains("cfl"));
    CHECK(by_dt["steps"] == 7);
    CHECK(by_dt["options"]["steps"] == 7);
    CHECK_FALSE(by_dt["options"].contains("time"));
}

TEST_CASE("the skin of the summary is the one used, and a thicker one is rebuilt less often", "[programs]") {
    const auto by_default = read_summary(run_coarse("", "skin_default"));
    const auto thick = read_summary(run_coarse("--skin 0.8", "skin_thick"));
    CHECK(by_default["options"]["skin"].get<double>() > 0.005);  // chosen, between 0.02 and 4 times the mean face size, 0.25
    CHECK(by_default["options"]["skin"].get<double>() < 1.0);
    CHECK(thick["options"]["skin"] == 0.8);
    CHECK(thick["rebuilds"] < by_default["rebuilds"]);
    CHECK(by_default["options"]["threads"] > 0);
}

TEST_CASE("the length of a cylinder is a factor of its mass", "[programs]") {
    const auto solid = read_summary(run_coarse("--set bodies.left.length=0.6 --steps 1", "length", 3));
    CHECK(solid["bodies"][0]["mass"].get<double>() == Approx(0.6 * solid["bodies"][1]["mass"].get<double>()).epsilon(0.02));
}

TEST_CASE("the offset is that of the centres", "[programs]") {
    const auto frontal = read_summary(run_coarse("--set values.offset=0", "no_offset"));
    const auto oblique = read_summary(run_coarse("--set values.offset=-0.8", "offset"));
    CHECK(std::abs(frontal["bodies"][0]["velocity_final"][1].get<double>()) < 0.005);
    CHECK(oblique["bodies"][0]["velocity_final"][1].get<double>() > 0.02);  // the right one is below: pushed up
    CHECK(oblique["options"]["set"].back() == "values.offset=-0.8");
}

TEST_CASE("two meshes from files collide", "[programs]") {
    const Folder meshes("good_meshes");
    const auto left = meshes.path() / "left.msh", right = meshes.path() / "right.msh";
    write_square(left, -1.05, -0.5, 1.0, 5);
    write_square(right, 0.05, -0.4, 1.0, 6);
    const auto outcome = run_well("abut", two_meshes(2, left, right, "--time 8 --frames 0"), "from_files");
    const auto summary = read_summary(outcome);
    CHECK(summary["cells"] == 25 + 36);
    CHECK(summary["events"] > 0);
    CHECK(summary["missed_contacts"] == 0);
    CHECK(relative_drift(outcome) <= 1e-11);
    for (const auto& body : summary["bodies"]) CHECK(body["mass"].get<double>() == Approx(1.0));
}

TEST_CASE("what is left out of a mesh file, and meshes that match by accident, are said and counted", "[programs]") {
    const Folder meshes("accidents");
    const auto left = meshes.path() / "left.msh", right = meshes.path() / "right.msh";
    write_square(left, -1.0, 0.0, 1.0, 3);
    write_square(right, 0.0, 0.0, 1.0, 3);  // shares the four places of an edge
    std::string text = read_text(right);
    text.replace(text.find("$Elements\n9\n"), 12, "$Elements\n10\n");
    text.replace(text.find("$EndElements"), 12, "10 1 2 0 1 1 2\n$EndElements");  // a line that is in no group
    std::ofstream(right) << text;
    const auto outcome = run_well("abut", two_meshes(2, left, right, "--steps 2 --frames 0"), "accidents_found");
    const auto mesh = read_summary(outcome)["mesh"];
    CHECK(mesh["ignored_elements"] == 1);
    CHECK(mesh["coincident_vertices"] == 8);
    CHECK(outcome.out.find("1 element is left out: neither cells nor faces") != std::string::npos);
    CHECK(outcome.out.find("8 vertices lie on a vertex of another body") != std::string::npos);
}

TEST_CASE("warped hexahedra of a file are refused, or cut and counted where asked for", "[programs]") {
    const Folder meshes("warped");
    std::array<std::string, 2> files;
    for (const int body : {0, 1}) {
        files[body] = (meshes.path() / fmt::format("body_{}.msh", body)).string();
        std::ofstream file(files[body]);
        file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n27\n";
        for (int i = 0; i < 27; ++i) {
            const int x = i % 3, y = i / 3 % 3, z = i / 9;
            file << i + 1 << " " << x + 3 * body << " " << y << " " << (i == 13 ? 1.1 : z) << "\n";  // its middle is moved
        }
        file << "$EndNodes\n$Elements\n8\n";
        for (int i = 0; i < 8; ++i) {
            const int n = 1 + i % 2 + 3 * (i / 2 % 2) + 9 * (i / 4);
            file << fmt::format("{} 5 2 1 1 {} {} {} {} {} {} {} {}\n", i + 1, n, n + 1, n + 4, n + 3, n + 9, n + 10, n + 13,
                                n + 12);
        }
        file << "$EndElements\n";
    }
    const auto arguments = two_meshes(3, files[0], files[1], "--steps 2 --frames 0 ");
    const auto refused = run_program("abut", arguments, "warped_refused");
    CHECK(refused.exit_code == 1);
    CHECK(refused.error.find("is not planar") != std::string::npos);
    CHECK(refused.error.find("non_planar = \"split\"") != std::string::npos);
    const auto summary = read_summary(run_well(
        "abut", arguments + "--set bodies.left.non_planar=split --set bodies.right.non_planar=split", "warped_split"));
    CHECK(summary["mesh"]["cut_cells"] == 16);
    CHECK(summary["cells"].get<int>() >= 5 * 16);
}

TEST_CASE("summary.json holds all that a reader is promised", "[programs]") {
    const auto outcome = run_coarse("--time 1", "summary");
    const auto summary = read_summary(outcome);
    for (const char* name : {"dim",
                             "cells",
                             "steps",
                             "dt",
                             "stable_dt",
                             "kinetic_initial",
                             "finest_dt",
                             "force_evaluations",
                             "pseudo_energy_drift",
                             "energy_drift",
                             "energy_excess_max",
                             "parasitic_max",
                             "momentum_drift_max",
                             "angular_momentum_drift_max",
                             "events",
                             "active_pairs_max",
                             "missed_contacts",
                             "candidates",
                             "rebuilds",
                             "not_admitted_max",
                             "stencil_faces",
                             "stencil_extrapolations",
                             "stencil_worst_weight",
                             "compression_max",
                             "compressed_steps",
                             "tilted_pairs_max",
                             "time",
                             "dt_over_stable_dt",
                             "contact_share"}) {
        INFO(name);
        REQUIRE(summary.contains(name));
        CHECK(summary[name].is_number());
    }
    REQUIRE(summary["bodies"].size() == 2);
    for (const auto& body : summary["bodies"]) {
        CHECK(body["mass"].get<double>() > 0.0);
        for (const char* name : {"velocity_initial", "velocity_final"}) CHECK(body[name].size() == 2);
    }
    double parts = 0.0;
    for (const char* name : {"total", "mesh", "setup", "bulk", "contact", "search", "ledger", "output"}) {
        CHECK(summary["seconds"][name].get<double>() >= 0.0);
        if (name != std::string("total")) parts += summary["seconds"][name].get<double>();
    }
    CHECK(parts <= summary["seconds"]["total"].get<double>());
    for (const char* name : {"scene", "set",      "cfl",        "time",       "broad_phase", "overlap",          "weighting",
                             "area",  "events",   "quadrature", "free_faces", "corners",     "filter",           "threads",
                             "out",   "interval", "skin",       "integrator", "frames",      "compression_limit"})
        CHECK(summary["options"].contains(name));
}

TEST_CASE("strong compression is warned of with its number", "[programs]") {
    const auto gentle = run_coarse("--set values.speed=0.02 --time 6", "gentle");
    CHECK(gentle.out.find("strongly compressed") == std::string::npos);
    const auto hard = run_coarse("--set values.speed=0.15 --time 4", "hard");
    const auto summary = read_summary(hard);
    REQUIRE(summary["compression_max"].get<double>() > 0.3);
    std::smatch found;
    REQUIRE(
        std::regex_search(hard.out, found, std::regex("strongly compressed in (\\d+) of (\\d+) steps, at most ([\\d.]+)")));
    // Of all pairs of faces, those that bear next to nothing included, the summary has as much or more.
    CHECK(std::stoi(found[1]) > 0);
    CHECK(std::stoi(found[1]) <= summary["compressed_steps"].get<int>());
    CHECK(std::stoi(found[2]) == summary["steps"].get<int>());
    CHECK(std::stod(found[3]) > 0.3);
    CHECK(std::stod(found[3]) <= 1.05 * summary["compression_max"].get<double>());  // two digits
}
