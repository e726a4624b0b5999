#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

/// Without a picture: it takes longer than the run.
Outcome bar(const std::string& arguments, const std::string& folder) {
    return run_well("study bouncing_bar", arguments, folder, "PATH=/nowhere");
}

// What a prototype in another language gave for the single impact under MEMM; the pressure is that of the middle 80 %.
struct Reference {
    int cells;
    double pressure, rms;  // [Pa]
    double release;        // [s]
    double rebound;        // [m/s]
    double excess;         // max (H - H~) / H0
};
const std::vector<Reference> references = {{100, 299.9, 13.1, 1.1717, 9.882, 1.0e-3},
                                           {800, 300.0, 4.6, 1.1677, 9.970, 1.3e-4}};

}  // namespace

TEST_CASE("the chain that hits a wall once does so as a prototype in another language found", "[programs]") {
    const Reference& reference = GENERATE(from_range(references));
    const auto outcome = bar(fmt::format("--gravity 0 --integrator memm --cells {}", reference.cells), "bar_impact");
    const auto of = [&](const char* name) { return figure(outcome, "memm", name); };
    CHECK(of("pressure_mean") == Approx(reference.pressure).margin(0.06));
    CHECK(of("pressure_rms") == Approx(reference.rms).epsilon(0.02));
    CHECK(of("release_first") == Approx(reference.release).margin(1e-4));
    CHECK(of("rebound_speed") == Approx(reference.rebound).margin(1e-3));
    CHECK(of("excess_relative") == Approx(reference.excess).epsilon(0.05));
    CHECK(of("drift_relative") < 1e-12);
    CHECK(of("events") == 2);
}

TEST_CASE("under every integrator the impact tends to pressure v0 sqrt(E rho), time 2L/c and rebound v0", "[programs]") {
    const auto coarse = bar("--gravity 0 --cells 50", "bar_coarse"), fine = bar("--gravity 0 --cells 200", "bar_fine");
    for (const char* scheme : {"memm", "leapfrog", "bilbao", "energy_momentum", "memm_async"}) {
        CAPTURE(scheme);
        CHECK(figure(fine, scheme, "pressure_mean") == Approx(300.0).epsilon(2e-3));
        CHECK(figure(fine, scheme, "release_first") == Approx(0.5 + 2.0 / 3.0).margin(10.0 / 200.0 / 30.0 * 3.0));
        CHECK(figure(fine, scheme, "rebound_speed") == Approx(10.0).epsilon(0.01));
        CHECK(10.0 - figure(fine, scheme, "rebound_speed") < 0.6 * (10.0 - figure(coarse, scheme, "rebound_speed")));
    }
}

TEST_CASE("under gravity the chain bounces as the bar does: impulse 2 rho L (v0 + g L/c), pressure 300 to 500",
          "[programs]") {
    const auto coarse = bar("--cells 50 --steps 1600", "bar_bounce"),
               fine = bar("--cells 200 --steps 6400", "bar_fine_bounce");
    for (const char* scheme : {"memm", "leapfrog", "bilbao", "energy_momentum", "memm_async"}) {
        CAPTURE(scheme);
        CHECK(figure(fine, scheme, "impulse_first") == Approx(2.0 * 10.0 * (10.0 + 10.0 / 3.0)).epsilon(2e-3));
        CHECK(figure(fine, scheme, "pressure_mean") == Approx(400.0).epsilon(3e-3));
        CHECK(figure(fine, scheme, "impacts") == 2);
        CHECK(figure(fine, scheme, "foot_error_max") < 0.5 * figure(coarse, scheme, "foot_error_max"));
        CHECK(figure(fine, scheme, "foot_error_max") < 0.03 * 5.0);  // of the height of fall
    }
    for (const char* scheme : {"memm", "bilbao", "energy_momentum", "memm_async"})
        CHECK(figure(fine, scheme, "drift_relative") < 1e-12);
    CHECK(figure(fine, "leapfrog", "drift_relative") > 1e-6);
}

TEST_CASE("the filter makes the parasitic mode of the chain smaller and leaves its pseudo-energy alone", "[programs]") {
    const std::string bounces = "--integrator memm --steps 30000 --filter ";
    const auto plain = bar(bounces + "none", "bar_plain"), filtered = bar(bounces + "neutral", "bar_filtered");
    for (const auto& outcome : {plain, filtered}) CHECK(figure(outcome, "memm", "drift_relative") < 1e-12);
    CHECK(figure(filtered, "memm", "parasitic_max") < 0.5 * figure(plain, "memm", "parasitic_max"));
    CHECK(figure(filtered, "memm", "excess_relative") <= figure(plain, "memm", "excess_relative"));
}

TEST_CASE("restarts take the parasitic mode of the chain out near the stable limit, where the filter leaves most of H - H~",
          "[programs]") {
    const std::string bounces = "--integrator memm --cfl 0.9 --steps 200000 --filter neutral";
    const auto filtered = bar(bounces, "bar_fast"), both = bar(bounces + " --restart 50", "bar_restarted");
    for (const auto& outcome : {filtered, both}) CHECK(figure(outcome, "memm", "drift_relative") < 1e-12);
    CHECK(figure(both, "memm", "excess_relative") < 0.5 * figure(filtered, "memm", "excess_relative"));
    CHECK(figure(both, "memm", "parasitic_max") < figure(filtered, "memm", "parasitic_max"));
}
