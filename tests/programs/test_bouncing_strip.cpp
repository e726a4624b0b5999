#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

double number(const Outcome& outcome, const char* name) { return read_summary(outcome)[name].get<double>(); }

}  // namespace

TEST_CASE("the bouncing strip keeps its pseudo-energy, and the filter makes the parasitic mode smaller", "[programs]") {
    const std::string bounces = "--steps 6000 --frames 0 --filter ";
    const auto plain = run_well("study bouncing_strip", bounces + "none", "strip_plain");
    const auto filtered = run_well("study bouncing_strip", bounces + "neutral", "strip_filtered");
    for (const auto& outcome : {plain, filtered}) {
        CHECK(read_summary(outcome)["impacts"] >= 3);
        CHECK(relative_drift(outcome) <= 1e-12);
        CHECK(number(outcome, "missed_contacts") == 0);
        CHECK(number(outcome, "energy_excess_max") >= 0.0);
    }
    CHECK(number(filtered, "parasitic_max") < 0.5 * number(plain, "parasitic_max"));
    CHECK(number(filtered, "energy_excess_max") <= number(plain, "energy_excess_max"));
}

TEST_CASE("the first impulse of the bouncing strip converges to 2 rho L (v0 + g L/c)", "[programs]") {
    const double exact = 2.0 * 1.0 * 10.0 * (10.0 + 10.0 * 10.0 / 30.0);
    const auto coarse = run_well("study bouncing_strip", "--cells 50 --time 2.5 --frames 0", "strip_coarse");
    const auto fine = run_well("study bouncing_strip", "--cells 100 --time 2.5 --frames 0", "strip_fine");
    CHECK(number(fine, "impulse_exact") == Approx(exact));
    CHECK(number(fine, "impulse_first") == Approx(exact).epsilon(2e-3));
    CHECK(std::abs(number(fine, "impulse_first") - exact) < std::abs(number(coarse, "impulse_first") - exact));
}

TEST_CASE("the bouncing strip leaves the files of all programs that run a scene and says how far its foot gave way",
          "[programs]") {
    const auto outcome = run_well("study bouncing_strip", "--steps 1200 --frames 3", "strip_files");
    for (const char* file :
         {"energy.csv", "energy.svg", "summary.json", "strip.pvd", "strip_surface.pvd", "frames/strip_000002.vtu"})
        CHECK(std::filesystem::exists(outcome.directory / file));
    const auto summary = read_summary(outcome);
    CHECK(read_energies(outcome).rows.size() == 1 + 1200 / 100);
    CHECK(summary["kinetic_initial"] == 0.0);
    CHECK(summary["energy_scale"]["name"] == "H0");
    CHECK(summary["energy_scale"]["value"].get<double>() == Approx(1.0 * 10.0 * 0.2 * 10.0 * 5.0));
    CHECK(summary["compression_max"].get<double>() > 0.3);
    CHECK(summary["compressed_steps"] > 0);
    CHECK(outcome.out.find("max |g|/D") != std::string::npos);
    CHECK(outcome.out.find("strongly compressed in") != std::string::npos);
}

TEST_CASE("the bouncing strip stops where a named limit of compression is exceeded", "[programs]") {
    const auto outcome = run_program("study bouncing_strip", "--steps 1200 --frames 0 --compression-limit 1", "strip_limit");
    CHECK(outcome.exit_code == 1);
    for (const char* word : {"step ", "face ", "(body 0, at (", "allowed"})
        CHECK(outcome.error.find(word) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(outcome.directory / "summary.json"));
}

TEST_CASE("the stabilisation of the bouncing strip is given in pascals", "[programs]") {
    const auto given = run_well("study bouncing_strip", "--steps 10 --frames 0 --eta 900", "strip_eta");
    const auto by_default = run_well("study bouncing_strip", "--steps 10 --frames 0", "strip_no_eta");
    const auto softer = run_well("study bouncing_strip", "--steps 10 --frames 0 --eta 630", "strip_soft");
    CHECK(number(given, "stable_dt") == number(by_default, "stable_dt"));
    CHECK(number(softer, "stable_dt") > number(given, "stable_dt"));
    CHECK(read_summary(by_default)["options"]["eta"] == 900.0);
}
