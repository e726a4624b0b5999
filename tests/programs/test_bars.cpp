#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;
using nlohmann::json;

constexpr double bar_length = 10.0, wave_speed = 30.0;  // of all bars but the fixed one

/// Without a picture: it takes longer than the run.
Outcome bars(const std::string& program, const std::string& arguments, const std::string& folder) {
    return run_well(program, arguments, folder, "PATH=/nowhere");
}

double value(const Outcome& outcome, const std::string& name, std::size_t level = 0) {
    return study_quantity(outcome, level, name).value;
}
double order(const Outcome& outcome, const std::string& name) { return read_summary(outcome)["orders"][name].get<double>(); }

/// Energies of all levels: exact to round-off, with what H~ does not see beside it.
void check_energies(const Outcome& outcome) {
    const json summary = read_summary(outcome);
    for (const json& level : summary["levels"]) {
        const json& energies = level["energies"];
        CHECK(energies["pseudo_energy_drift"] <= 1e-12);
        CHECK(energies["energy_excess_max"] >= 0.0);
        CHECK(energies["energy_excess_max"] < 0.01);
        CHECK(energies["events"] >= 2);
    }
}

}  // namespace

TEST_CASE("a bar presses on a wall with v0 sqrt(E rho), whether chain, strip of squares or strip of cubes",
          "[programs][bars]") {
    const auto [body, cells] =
        GENERATE(table<std::string, std::string>({{"chain", "100,200"}, {"strip2d", "100,200"}, {"strip3d", "100"}}));
    CAPTURE(body);
    const auto outcome = bars("study bar_impact", fmt::format("--body {} --cells {}", body, cells), "impact");
    CHECK(value(outcome, "pressure, mean") == Approx(10.0 * std::sqrt(900.0)).epsilon(2e-3));
    CHECK(value(outcome, "contact from") == Approx(0.5).epsilon(1e-12));
    check_energies(outcome);
}

TEST_CASE("the chain of 100 masses rebounds from a wall at 98.5 % of its speed and is released within 1.5 h/c",
          "[programs][bars]") {
    const auto outcome = bars("study bar_impact", "--body chain --cells 100", "impact_chain");
    CHECK(value(outcome, "rebound of the centre of mass") >= 0.985 * 10.0);
    CHECK(value(outcome, "released at") == Approx(0.5 + 2.0 * bar_length / wave_speed).margin(1.5 * 0.1 / wave_speed));
}

TEST_CASE("release and rebound tend to the exact ones like h^(2/3), by as much as dispersion says", "[programs][bars]") {
    const auto [body, tolerance] = GENERATE(table<std::string, double>({{"chain", 0.15}, {"strip2d", 0.02}}));
    CAPTURE(body);
    const auto outcome = bars("study bar_impact", fmt::format("--body {} --cells 100,200,400", body), "impact_orders");
    CHECK(value(outcome, "delay of release / that of dispersion", 2) == Approx(1.0).margin(tolerance));
    CHECK(value(outcome, "loss of speed / that of dispersion", 2) == Approx(1.0).margin(tolerance));
    if (body == "strip2d")  // the pressure of the chain oscillates when it comes to zero, and its release with it
        CHECK(order(outcome, "released at") == Approx(2.0 / 3.0).margin(0.06));
    CHECK(order(outcome, "rebound of the centre of mass") == Approx(2.0 / 3.0).margin(0.06));
    CHECK(order(outcome, "max (H - H~) / H0") == Approx(1.0).margin(0.15));
}

TEST_CASE("the pressure of the chain oscillates about the exact one, rms like h^(1/2)", "[programs][bars]") {
    const auto outcome = bars("study bar_impact", "--body chain --cells 50,100,200,400", "impact_gibbs");
    CHECK(order(outcome, "pressure - exact, rms") == Approx(0.5).margin(0.05));
}

TEST_CASE("a strip of 200 cells rebounds from a wall at 98.5 % of its speed, and cubes are as good as squares",
          "[programs][bars]") {
    const auto squares = bars("study bar_impact", "--body strip2d --cells 50,200", "impact_squares");
    CHECK(value(squares, "rebound of the centre of mass", 1) >= 0.985 * 10.0);
    const auto cubes = bars("study bar_impact", "--body strip3d --cells 50", "impact_cubes");
    CHECK(value(cubes, "rebound of the centre of mass") ==
          Approx(value(squares, "rebound of the centre of mass")).epsilon(1e-3));
    CHECK(value(cubes, "released at") == Approx(value(squares, "released at")).epsilon(1e-3));
}

TEST_CASE("a falling bar gives the wall 2 rho L (v0 + g L/c), pressed from 300 to 500 Pa, and comes back after 16/3 s",
          "[programs][bars]") {
    const auto [body, cells] =
        GENERATE(table<std::string, std::string>({{"chain", "50,100,200"}, {"strip2d", "50,100"}, {"strip3d", "50"}}));
    CAPTURE(body);
    const auto outcome = bars("study falling_bar", fmt::format("--body {} --cells {}", body, cells), "falling");
    const std::size_t finest = read_summary(outcome)["levels"].size() - 1;
    CHECK(value(outcome, "impact 1: impulse", finest) ==
          Approx(2.0 * bar_length * (10.0 + 10.0 * bar_length / wave_speed)).epsilon(3e-3));
    CHECK(value(outcome, "impact 1: pressure at its begin", finest) == Approx(300.0).epsilon(5e-3));
    CHECK(value(outcome, "impact 1: pressure at its end", finest) == Approx(500.0).epsilon(5e-3));
    check_energies(outcome);
    if (finest == 0) return;
    CHECK(value(outcome, "period, impacts 1 and 3", finest) == Approx(16.0 / 3.0).epsilon(0.01));
    for (const char* name : {"impact 2: impulse", "impact 3: impulse", "period, impacts 1 and 3", "impact 1: released at"}) {
        CAPTURE(name);
        CHECK(study_quantity(outcome, finest, name).error < study_quantity(outcome, 0, name).error);
    }
}

TEST_CASE("a bar that is fixed at one end presses on a wall from 1 to 2 s with half a pascal, again and again",
          "[programs][bars]") {
    const auto [body, cells] =
        GENERATE(table<std::string, std::string>({{"chain", "50,100,200"}, {"strip2d", "50,100,200"}, {"strip3d", "50"}}));
    CAPTURE(body);
    const auto outcome = bars("study fixed_bar", fmt::format("--body {} --cells {}", body, cells), "fixed");
    const std::size_t finest = read_summary(outcome)["levels"].size() - 1;
    const double h = finest > 0 ? 1.0 / 200.0 : 1.0 / 50.0;
    CHECK(value(outcome, "contact from", finest) == Approx(1.0).margin(1.5 * h));
    CHECK(value(outcome, "period, both contacts", finest) == Approx(3.0).margin(1.5 * h));
    CHECK(value(outcome, "energy at the start", finest) == Approx(0.125).epsilon(1.5 * h));
    check_energies(outcome);
    if (finest == 0) return;
    CHECK(value(outcome, "contact stress, mean", finest) == Approx(-0.5).epsilon(2e-3));
    CHECK(order(outcome, "released at") == Approx(2.0 / 3.0).margin(0.06));
    CHECK(order(outcome, "energy at the start") == Approx(1.0).margin(0.01));
    CHECK(order(outcome, "displacement after a period, L2 error") > 0.6);
    CHECK(value(outcome, "displacement after a period, L2 error", finest) < 0.025);
}

TEST_CASE("two equal bars exchange their velocities, with faces that match or not, in 2D and 3D", "[programs][bars]") {
    const auto [options, cells] =
        GENERATE(table<std::string, std::string>({{"--body strip2d --cells 200", "matching"},
                                                  {"--body strip2d --cells 170 --cells-2 240", "not"},
                                                  {"--body strip2d --cells 200 --speed 0.1,0", "at rest"}}));
    CAPTURE(cells);
    const auto outcome = bars("study two_bars", options, "two_bars");
    CHECK(value(outcome, "exchanged") >= 0.985);
    CHECK(value(outcome, "pressure, mean") == Approx(study_quantity(outcome, 0, "pressure, mean").reference).epsilon(2e-3));
    check_energies(outcome);
}

TEST_CASE("two bars of cubes exchange their velocities as those of squares do", "[programs][bars]") {
    const std::string mesh = "--cells 50 --cells-2 70";
    const auto squares = bars("study two_bars", mesh, "two_squares"),
               cubes = bars("study two_bars", "--body strip3d " + mesh, "two_cubes");
    for (const char* name : {"exchanged", "contact lasts"})
        CHECK(value(cubes, name) == Approx(value(squares, name)).epsilon(1e-3));
    CHECK(value(cubes, "pressure, mean") == Approx(30.0 * 0.1).epsilon(5e-3));
    check_energies(cubes);
}

TEST_CASE("a bar that is at rest takes over the velocity of the other one", "[programs][bars]") {
    const auto outcome = bars("study two_bars", "--cells 100 --speed 0.1,0", "at_rest");
    CHECK(value(outcome, "lower bar, velocity after") == Approx(0.0).margin(0.015 * 0.1));
    CHECK(value(outcome, "upper bar, velocity after") == Approx(0.1).margin(0.015 * 0.1));
    CHECK(study_quantity(outcome, 0, "pressure, mean").reference == Approx(30.0 * 0.05));
}

TEST_CASE("bars that slip off each other and pass through say so", "[programs][bars]") {
    const auto outcome = bars("study two_bars", "--cells 50 --cells-2 70 --speed 10", "slipped");
    CHECK(value(outcome, "exchanged") < 0.5);
    CHECK_THAT(outcome.out, Catch::Matchers::Contains("slid off each other"));
    const auto slow = bars("study two_bars", "--cells 50 --cells-2 70", "exchanged");
    CHECK_THAT(slow.out, !Catch::Matchers::Contains("slid off each other"));
}

TEST_CASE("programs with bars leave values, curves and a picture", "[programs][bars]") {
    const auto [program, more] = GENERATE(table<std::string, std::string>(
        {{"study bar_impact", ""}, {"study falling_bar", ""}, {"study fixed_bar", "profiles.csv"}, {"study two_bars", ""}}));
    const std::string name = program.substr(std::string("study ").size());
    const auto outcome = run_well(program, "--cells 16", "bar_files");
    for (const std::string& file : {std::string("values.csv"), std::string("history.csv"), std::string("exact.csv"),
                                    std::string("summary.json"), name + ".gp", more})
        if (!file.empty()) CHECK(std::filesystem::exists(outcome.directory / file));
    const bool is_drawn = outcome.out.find("no picture") == std::string::npos;
    CHECK(is_drawn == std::filesystem::exists(outcome.directory / (name + ".png")));
}

TEST_CASE("programs with bars say what is wrong with their options", "[programs][bars]") {
    const auto [program, options, word] = GENERATE(
        table<std::string, std::string, std::string>({{"study bar_impact", "--body chain --weighting half", "--weighting"},
                                                      {"study bar_impact", "--cells 50,x", "--cells"},
                                                      {"study bar_impact", "--cells 50,", "--cells"},
                                                      {"study bar_impact", "--cells 50 --body strip3d --cfl 0.9", "--cfl"},
                                                      {"study two_bars", "--cells 50 --cells-2 50,60", "--cells-2"},
                                                      {"study two_bars", "--speed 0", "--speed"}}));
    const auto outcome = run_program(program, options, "bar_errors");
    CAPTURE(options, outcome.error);
    CHECK(outcome.exit_code == 1);
    CHECK(outcome.error.find(word) != std::string::npos);
}
