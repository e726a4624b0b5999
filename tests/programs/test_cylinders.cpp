#include <fmt/format.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

/// Small scenes: 2D as it is by default, 3D coarse.
struct SmallScene {
    std::string arguments;
    const char* folder;
};
const SmallScene slipping_2d{slip("--frames 0"), "slipping_2d"};
const SmallScene rebounding_2d{slip("--set values.offset=0 --frames 0"), "rebounding_2d"};
const SmallScene slipping_3d{slip_3d("--set values.size=0.25 --frames 0 --interval 1"), "slipping_3d"};
const SmallScene rebounding_3d{slip_3d("--set values.offset=0 --set values.size=0.25 --frames 0 --interval 1"),
                               "rebounding_3d"};

Outcome run_small(const SmallScene& scene, const std::string& more = "", const std::string& folder_end = "") {
    return run_well("abut", fmt::format("{} {}", scene.arguments, more), scene.folder + folder_end);
}

/// m v0, summed over the bodies without sign.
double momentum_scale(const nlohmann::json& summary) {
    double scale = 0.0;
    for (const auto& body : summary["bodies"])
        scale += body["mass"].get<double>() * std::abs(body["velocity_initial"][0].get<double>());
    return scale;
}

void check_impact_and_release(const nlohmann::json& summary) {
    CHECK(summary["active_pairs_max"] > 0);
    CHECK(summary["active_pairs_final"] == 0);
    CHECK(summary["events"] > 0);
    for (const auto& body : summary["bodies"])
        CHECK(body["velocity_final"][0].get<double>() * body["velocity_initial"][0].get<double>() < 0.0);
}

std::set<std::string> names_in_list(const std::filesystem::path& list) {
    const std::string text = read_text(list);
    const std::regex entry("file=\"([^\"]+)\"");
    std::set<std::string> names;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), entry); match != std::sregex_iterator(); ++match)
        names.insert((*match)[1]);
    return names;
}

}  // namespace

TEST_CASE("pseudo-energy and momentum hold to round-off through impact, slip and release", "[programs]") {
    const SmallScene scene = GENERATE(slipping_2d, rebounding_2d, slipping_3d, rebounding_3d);
    CAPTURE(scene.folder);
    const auto outcome = run_small(scene);
    const auto summary = read_summary(outcome);
    CHECK(summary["pseudo_energy_drift"].get<double>() <= 1e-11 * summary["kinetic_initial"].get<double>());
    CHECK(summary["momentum_drift_max"].get<double>() <= 1e-12 * momentum_scale(summary));
    CHECK(summary["energy_excess_max"].get<double>() <= 1e-2 * summary["kinetic_initial"].get<double>());
    CHECK(summary["energy_excess_max"].get<double>() >= 0.0);
    CHECK(summary["missed_contacts"] == 0);
    check_impact_and_release(summary);
}

TEST_CASE("without events, or with one point too few, the energy drifts at least 1,000 times more", "[programs]") {
    const auto [scene, one_point_too_few] =
        GENERATE(table<SmallScene, std::string>({{slipping_2d, "--lab quadrature=1"}, {slipping_3d, "--lab quadrature=2"}}));
    CAPTURE(scene.folder);
    const double exact = relative_drift(run_small(scene, "", "_exact"));
    for (const std::string& inexact : {std::string("--lab events=off"), one_point_too_few}) {
        CAPTURE(inexact);
        CHECK(relative_drift(run_small(scene, inexact, "_inexact")) >= 1e3 * exact);
    }
}

TEST_CASE("the broad phase and the number of threads do not change a bit of energy.csv", "[programs]") {
    const SmallScene scene = GENERATE(slipping_2d, slipping_3d);
    CAPTURE(scene.folder);
    const auto reference = run_small(scene, "--lab broad_phase=embree", "_reference");
    const auto expected = read_summary(reference);
    for (const std::string other :
         {"--lab broad_phase=fcl", "--lab broad_phase=brute_force", "--threads 1", "--threads 2", "--threads 4"}) {
        CAPTURE(other);
        const auto outcome = run_small(scene, other, "_other");
        CHECK(read_text(reference.directory / "energy.csv") == read_text(outcome.directory / "energy.csv"));
        const auto summary = read_summary(outcome);
        for (const char* name : {"dt", "stable_dt", "pseudo_energy_drift", "momentum_drift_max", "events",
                                 "active_pairs_max", "candidates", "rebuilds", "compression_max", "bodies"})
            CHECK(expected[name] == summary[name]);
    }
}

TEST_CASE("energy.csv holds a row for every record and what the summary says", "[programs]") {
    const auto outcome = run_well("abut", slip("--frames 0 --interval 7"), "records");
    const auto summary = read_summary(outcome);
    const Table table = read_energies(outcome);
    const auto steps = summary["steps"].get<std::size_t>();
    CHECK(table.rows.size() == 1 + steps / 7 + (steps % 7 == 0 ? 0 : 1));
    CHECK(table.columns == std::vector<std::string>{"step",
                                                    "time",
                                                    "pseudo_energy",
                                                    "energy",
                                                    "kinetic",
                                                    "potential",
                                                    "work",
                                                    "linear_momentum_x",
                                                    "linear_momentum_y",
                                                    "angular_momentum",
                                                    "parasitic",
                                                    "active_pairs",
                                                    "events",
                                                    "restart_jumps",
                                                    "rotation",
                                                    "rest_angular_momentum",
                                                    "restarts",
                                                    "restarts_shortened",
                                                    "restarts_skipped",
                                                    "restart_paid",
                                                    "pseudo_angular_momentum",
                                                    "dissipated",
                                                    "friction_energy",
                                                    "sticking_faces",
                                                    "sliding_faces",
                                                    "dissipated_by_friction",
                                                    "dissipated_in_cells",
                                                    "dissipated_in_jumps",
                                                    "dissipated_on_faces",
                                                    "dissipated_by_damping",
                                                    "dissipated_by_viscosity",
                                                    "damping_lagged",
                                                    "dissipated_in_bonds",
                                                    "dissipated_at_splits",
                                                    "eroded_cells",
                                                    "eroded_mass",
                                                    "eroded_kinetic",
                                                    "eroded_potential",
                                                    "eroded_momentum_x",
                                                    "eroded_momentum_y",
                                                    "eroded_rest_angular_momentum",
                                                    "eroded_pseudo_angular_momentum"});
    for (const auto& row : table.rows) CHECK(row.size() == table.columns.size());
    CHECK(table.rows.back().front() == static_cast<double>(steps));

    double drift = 0.0;
    for (const double energy : table.column("pseudo_energy"))
        drift = std::max(drift, std::abs(energy - table.column("pseudo_energy").front()));
    CHECK(drift == summary["pseudo_energy_drift"].get<double>());  // 17 digits lose nothing
    CHECK(table.column("kinetic").front() == summary["kinetic_initial"].get<double>());
    CHECK(std::ranges::max(table.column("parasitic")) == summary["parasitic_max"].get<double>());
}

TEST_CASE("the series for ParaView lists as many frames as asked for, and all of them are there", "[programs]") {
    const std::string arguments = GENERATE(slip("--set values.size=0.25"), slip_3d("--set values.size=0.4"));
    const auto outcome = run_well("abut", arguments + " --set values.offset=0 --frames 5", "frames");
    for (const char* list : {"bodies.pvd", "bodies_surface.pvd"}) {
        const auto names = names_in_list(outcome.directory / list);
        CHECK(names.size() == 5);
        for (const auto& name : names) CHECK(std::filesystem::file_size(outcome.directory / name) > 0);
    }
    const std::string last = read_text(outcome.directory / "frames/bodies_000004.vtu");
    for (const char* field : {"displacement", "velocity [m/s]", "stress [Pa]", "von Mises [Pa]"})
        CHECK(last.find(field) != std::string::npos);
    const std::string surface = read_text(outcome.directory / "frames/bodies_surface_000004.vtp");
    for (const char* field : {"contact pressure [Pa]", "gap [m]"}) CHECK(surface.find(field) != std::string::npos);
}

TEST_CASE("bodies of their own radius, stiffness, density and speed exchange momentum", "[programs]") {
    const auto outcome = run_well("abut",
                                  slip("--set values.offset=0 --set values.right_radius=0.5 --set values.size=0.2 --set "
                                       "bodies.right.size=0.1 --set bodies.right.young=10 --set bodies.right.density=4 "
                                       "--set bodies.left.velocity=[0,0] --set bodies.right.velocity=[-0.1,0] --frames 0"),
                                  "unequal");
    const auto summary = read_summary(outcome);
    const auto& bodies = summary["bodies"];
    CHECK(bodies[0]["mass"].get<double>() == Approx(std::acos(-1.0)).epsilon(0.02));
    CHECK(bodies[1]["mass"].get<double>() == Approx(std::acos(-1.0)).epsilon(0.02));
    CHECK(bodies[0]["velocity_initial"][0] == 0.0);
    CHECK(bodies[1]["velocity_initial"][0].get<double>() == Approx(-0.1));
    CHECK(bodies[0]["velocity_final"][0].get<double>() < -0.05);
    CHECK(summary["pseudo_energy_drift"].get<double>() <= 1e-11 * summary["kinetic_initial"].get<double>());
    CHECK(summary["options"]["set"][4] == "bodies.right.young=10");
}

TEST_CASE("the neutral filter makes the parasitic mode smaller and leaves the pseudo-energy exact", "[programs]") {
    const auto plain = run_small(slipping_2d, "--filter none", "_plain");
    const auto filtered = run_small(slipping_2d, "--filter neutral", "_filtered");
    CHECK(read_summary(filtered)["energy_excess_max"] < read_summary(plain)["energy_excess_max"]);
    CHECK(relative_drift(filtered) <= 1e-11);
}

TEST_CASE("a log that is no terminal gets plain lines, about one for every tenth of the run", "[programs]") {
    const auto outcome = run_well("abut", slip("--set values.size=0.25 --frames 0"), "log");
    CHECK(outcome.out.find('\r') == std::string::npos);
    CHECK(outcome.out.find('\033') == std::string::npos);
    CHECK(outcome.error.empty());
    const std::regex line("energy drift");
    const auto lines =
        std::distance(std::sregex_iterator(outcome.out.begin(), outcome.out.end(), line), std::sregex_iterator());
    CHECK(lines >= 9);
    CHECK(lines <= 11);
}

TEST_CASE("a run draws its energies with no other program", "[programs]") {
    const auto outcome = run_well("abut", slip("--set values.size=0.25 --frames 0"), "picture", "PATH=/nowhere");
    CHECK(outcome.out.find("energy.svg") != std::string::npos);
    const std::string picture = read_text(outcome.directory / "energy.svg");
    CHECK(picture.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
    for (const char* word : {"slipping_cylinders", "kinetic", "potential", "H~", "time [s]", "over K0"})
        CHECK(picture.find(word) != std::string::npos);
}
