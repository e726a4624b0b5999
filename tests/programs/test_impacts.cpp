#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <utility>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

}  // namespace

TEST_CASE("a disc that falls touches a plane when free fall says, except for its corners and a step", "[programs]") {
    const auto outcome = run_well("study disc_on_plane", "--cells 5,10", "disc_on_plane");
    for (std::size_t level = 0; level < 2; ++level) {
        const double size = read_summary(outcome)["levels"][level]["size"].get<double>();
        const auto fall = read_table(outcome, level == 0 ? "fall_5.csv" : "fall_10.csv");
        const double dt = fall.column("time")[1] - fall.column("time")[0];
        CHECK(std::abs(study_quantity(outcome, level, "first contact").value - 10.0) <
              size * size / (8.0 * 20.0) / 1.0 + dt);
        CHECK(read_summary(outcome)["levels"][level]["energies"]["pseudo_energy_drift"].get<double>() < 1e-12);
        for (std::size_t i = 0; fall.column("time")[i] < 9.9; ++i)
            CHECK(fall.column("velocity")[i] == Approx(-0.1 * fall.column("time")[i]).margin(1e-12));
    }
}

TEST_CASE("discs that collide keep momentum and pseudo-energy, and turn less on finer meshes", "[programs]") {
    const auto outcome = run_well("study disc_collision", "--size 0.25,0.125", "disc_collision");
    for (std::size_t level = 0; level < 4; ++level) {
        CHECK(study_quantity(outcome, level, "momentum, largest change").error < 1e-12);
        CHECK(study_quantity(outcome, level, "pseudo-energy, largest drift over K0").error < 1e-12);
    }
    for (const std::size_t offset : {0u, 2u})  // head-on, off-centre
        CHECK(study_quantity(outcome, offset + 1, "spin times R, over the speed").error <
              study_quantity(outcome, offset, "spin times R, over the speed").error);
}

TEST_CASE("curves of discs that collide go from the speeds at the start to those at the end", "[programs]") {
    const auto outcome = run_well("study disc_collision", "--size 0.25", "disc_velocities");
    std::size_t level = 0;
    for (const char* file : {"head_on_0.25.csv", "off_centre_0.25.csv"}) {
        const auto curve = read_table(outcome, file);
        for (const auto& [column, start] :
             {std::pair("left_x", 0.05), std::pair("left_y", 0.0), std::pair("right_x", -0.05), std::pair("right_y", 0.0)})
            CHECK(curve.column(column).front() == Approx(start).margin(1e-15));
        CHECK(curve.column("left_x").back() == study_quantity(outcome, level, "final speed along x").value);
        CHECK(curve.column("left_y").back() == study_quantity(outcome, level, "final speed along y").value);
        ++level;
    }
    CHECK(std::filesystem::exists(outcome.directory / "velocities.gp"));
}

TEST_CASE("spheres that collide come as close as Hertz says, within 10 % on a coarse mesh", "[programs][long]") {
    const auto outcome = run_well("study sphere_collision", "--faces 1.5 --coarse 0.8", "sphere_collision");
    CHECK(study_quantity(outcome, 0, "largest approach").error < 0.1);
    CHECK(study_quantity(outcome, 0, "duration").error < 0.1);
    CHECK(study_quantity(outcome, 0, "momentum, largest change").error < 1e-12);
    // The parasitic mode changes its sign with every step: nothing of it is left in the mean force of two.
    const auto impact = read_table(outcome, "impact_1.5.csv");
    const double largest = study_quantity(outcome, 0, "largest force, mean of two steps").value;
    CHECK(impact.column("force_of_two").back() == Approx(0.0).margin(1e-9 * largest));
    // Hertz's own law of motion, which the picture draws, reaches the closed forms.
    const auto hertz = read_table(outcome, "hertz.csv");
    double approach = 0.0;
    for (const double d : hertz.column("approach")) approach = std::max(approach, d);
    CHECK(approach == Approx(118.9e-6).epsilon(2e-3));
    CHECK(std::abs(hertz.column("approach").back()) < 1e-3 * approach);
}
