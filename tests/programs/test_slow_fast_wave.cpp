#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

/// Without a picture: it takes longer than the run.
Outcome wave(const std::string& arguments, const std::string& folder) {
    return run_well("study slow_fast_wave", arguments, folder, "PATH=/nowhere");
}

}  // namespace

TEST_CASE("local steps of the slow-fast wave err at most 1.2 times as much as fine ones, for 0.55 of the forces",
          "[programs]") {
    const auto outcome = wave("--cells 2000 --refinements 0", "wave_ratio");
    const auto summary = read_summary(outcome);
    CHECK(summary["error_ratio"].get<double>() <= 1.2);
    // Half of the bonds in each of ten steps and the other half in one, and the bond right of the interface.
    CHECK(summary["evaluation_ratio"].get<double>() == Approx((10.0 * 1001.0 + 999.0) / (10.0 * 2000.0)).epsilon(1e-12));
    for (const char* scheme : {"memm", "memm_async", "leapfrog"}) CHECK(figure(outcome, scheme, "drift_relative") < 1e-12);
}

TEST_CASE("the slow-fast wave converges to the reflected pulses with second order", "[programs]") {
    const auto outcome = wave("--cells 4000 --refinements 1 --time 0.1", "wave_order");
    for (const char* scheme : {"memm", "memm_async", "leapfrog"}) {
        CAPTURE(scheme);
        CHECK(figure(outcome, scheme, "order") == Approx(2.0).margin(0.1));
    }
    CHECK(figure(outcome, "memm", "error_l2") == Approx(figure(outcome, "leapfrog", "error_l2")).epsilon(1e-6));  // linear
}

TEST_CASE("the first pulse through the interface is 2 c1/(c1 + c2) times as high and a tenth as wide", "[programs]") {
    const auto outcome = wave("--cells 1000 --refinements 0", "wave_exact");
    const auto profile = read_table(outcome, "profile.csv");
    const auto x = profile.column("x"), exact = profile.column("exact");
    const double height = 0.01 * 20.0 / 11.0, place = 0.97, width = 0.1 / 20.0;
    for (const double shift : {-width, 0.0, width}) {
        const auto node = static_cast<std::size_t>(std::lround((place + shift) * 1000.0)) - 1;
        CHECK(x[node] == Approx(place + shift));
        CHECK(exact[node] == Approx(height * std::exp(-shift * shift / (width * width))));
    }
    CHECK(profile.columns == std::vector<std::string>{"x", "exact", "memm", "memm_async", "leapfrog"});
}
