#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;

/// Without a picture: it takes longer than the run.
Outcome fpu(const std::string& arguments, const std::string& folder) {
    return run_well("study fpu", arguments, folder, "PATH=/nowhere");
}

// What a prototype in another language gave over T = 200, relative to H0.
struct Reference {
    const char* dt;
    double leapfrog;    // max |H - H0|
    double memm;        // the same
    double memm_gauss;  // drift of H~ when the mean of the force is taken at one point
    double bilbao;      // max |H - H0| with c = 10
};
const std::vector<Reference> references = {{"1e-3", 1.57e-4, 1.57e-4, 6.2e-7, 1.67e-4},
                                           {"1e-2", 1.67e-2, 1.68e-2, 6.3e-5, 1.74e-2},
                                           {"2e-2", 7.90e-2, 7.85e-2, 2.7e-4, 9.2e-2}};
constexpr double digits = 0.02;

}  // namespace

TEST_CASE("the energies of the Fermi-Pasta-Ulam chain err as a prototype in another language found", "[programs]") {
    const Reference& reference = GENERATE(from_range(references));
    const std::string dt = fmt::format("--dt {} --integrator ", reference.dt);
    CAPTURE(reference.dt);
    CHECK(figure(fpu(dt + "leapfrog", "fpu_leapfrog"), "leapfrog", "energy_error_relative") ==
          Approx(reference.leapfrog).epsilon(digits));
    const auto bilbao = fpu(dt + "bilbao --gauge 10", "fpu_bilbao");
    CHECK(figure(bilbao, "bilbao", "energy_error_relative") == Approx(reference.bilbao).epsilon(digits));
    CHECK(figure(bilbao, "bilbao", "drift_relative") < 1e-12);
    for (const char* mean : {"system", "2"}) {
        const auto exact = fpu(dt + "memm --mean " + mean, "fpu_memm");
        CHECK(figure(exact, "memm", "energy_error_relative") == Approx(reference.memm).epsilon(digits));
        CHECK(figure(exact, "memm", "drift_relative") < 3e-13);
    }
    const auto one_point = fpu(dt + "memm --mean 1", "fpu_memm_1");
    CHECK(figure(one_point, "memm", "drift_relative") == Approx(reference.memm_gauss).epsilon(digits));
}

TEST_CASE("every integrator of the chain keeps its own energy to round-off but leapfrog", "[programs]") {
    const auto outcome = fpu("", "fpu_all");
    for (const char* scheme : {"memm", "bilbao", "energy_momentum", "memm_async"}) {
        CAPTURE(scheme);
        CHECK(figure(outcome, scheme, "drift_relative") < 1e-12);
    }
    CHECK(figure(outcome, "leapfrog", "drift_relative") > 1e-6);
    CHECK(figure(outcome, "energy_momentum", "energy_error_relative") < 1e-12);
    for (const char* scheme : {"memm", "leapfrog", "bilbao", "energy_momentum", "memm_async"})
        CHECK(figure(outcome, scheme, "energy_initial") == Approx(2.00120008).epsilon(1e-9));
    CHECK(outcome.out.find("H0 = 2.00120008 J") != std::string::npos);
}

TEST_CASE("a naive start of MEMM costs six times the error in energy", "[programs]") {
    const auto outcome = fpu("--integrator memm --start naive --dt 1e-2", "fpu_naive");
    CHECK(figure(outcome, "memm", "energy_error_relative") == Approx(0.102).epsilon(digits));
    CHECK(figure(outcome, "memm", "drift_relative") < 1e-12);
}

TEST_CASE("leapfrog and MEMM explode above omega dt = 2, H~ does not notice, and the program says so", "[programs]") {
    const auto stable = fpu("--dt 0.039", "fpu_stable");
    for (const char* scheme : {"memm", "leapfrog"})
        CHECK(read_summary(stable)["schemes"][scheme]["broken_off_time"].is_null());
    const auto outcome = run_program("study fpu", "--dt 0.041", "fpu_unstable");
    CHECK(outcome.exit_code == 1);
    const auto summary = read_summary(outcome);
    for (const char* scheme : {"memm", "leapfrog"}) {
        CAPTURE(scheme);
        CHECK(summary["schemes"][scheme]["broken_off_time"].get<double>() < 200.0);
        CHECK(figure(outcome, scheme, "energy_error_relative") > 1e3);
        CHECK(outcome.error.find(fmt::format("{} breaks off at step ", scheme)) != std::string::npos);
    }
    CHECK(figure(outcome, "memm", "drift_relative") < 1e-12);
    for (const char* scheme : {"bilbao", "energy_momentum"}) {
        CHECK(summary["schemes"][scheme]["broken_off_time"].is_null());
        CHECK(outcome.error.find(scheme) == std::string::npos);
    }
    CHECK(outcome.out.find("breaks off at [s]") != std::string::npos);
    CHECK(outcome.out.find("nan") == std::string::npos);
}

TEST_CASE("the springs exchange all of their energy, and its sum is an adiabatic invariant", "[programs]") {
    const auto outcome = fpu("--dt 1e-3 --integrator memm", "fpu_exchange");
    CHECK(figure(outcome, "memm", "I_start") == Approx(1.0).epsilon(1e-6));
    CHECK(figure(outcome, "memm", "I_deviation_max") < 5.0 / 50.0);  // of the order of 1/omega
    CHECK(figure(outcome, "memm", "I3_max") > 0.9);
    const auto series = read_table(outcome, "memm.csv");
    const auto i1 = series.column("I1"), i2 = series.column("I2"), i3 = series.column("I3"), i = series.column("I");
    for (std::size_t row = 0; row < i.size(); ++row) CHECK(i[row] == Approx(i1[row] + i2[row] + i3[row]));
    CHECK(i1.front() == Approx(1.0));
    CHECK(*std::min_element(i1.begin(), i1.end()) < 0.1);
}

TEST_CASE("local steps of the chain are MEMM with the short step where all masses are fast", "[programs]") {
    const auto local = fpu("--integrator memm_async --fast 6 --parts 4 --dt 0.02 --time 10", "fpu_fast");
    const auto fine = fpu("--integrator memm --dt 0.005 --time 10", "fpu_fine");
    CHECK(figure(local, "memm_async", "I_end") == Approx(figure(fine, "memm", "I_end")).epsilon(1e-10));
    CHECK(figure(local, "memm_async", "force_evaluations") == figure(fine, "memm", "force_evaluations"));
}
