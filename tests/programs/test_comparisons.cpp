// What the programs that compare integrators on small systems have in common.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "programs/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace abut::test::programs;

/// A short run of each program, and the files of numbers it leaves.
struct Comparison {
    std::string program;
    std::string arguments;
    std::vector<std::string> tables;
};
const std::vector<Comparison> comparisons = {
    {"bouncing_bar",
     "--cells 10 --steps 100",
     {"bilbao.csv", "energy_momentum.csv", "leapfrog.csv", "memm.csv", "memm_async.csv"}},
    {"fpu", "--time 2", {"bilbao.csv", "energy_momentum.csv", "leapfrog.csv", "memm.csv", "memm_async.csv"}},
    {"slow_fast_wave", "--cells 100 --refinements 0", {"profile.csv"}},
};

bool has_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

std::vector<std::string> expected_files(const Comparison& comparison, bool picture) {
    std::vector<std::string> files = comparison.tables;
    files.push_back(comparison.program + ".gp");
    if (picture) files.push_back(comparison.program + ".png");
    files.emplace_back("summary.json");
    std::ranges::sort(files);
    return files;
}

}  // namespace

TEST_CASE("a comparison leaves its tables, a picture and a summary, and nothing half written", "[programs]") {
    const Comparison& comparison = GENERATE(from_range(comparisons));
    CAPTURE(comparison.program);
    const auto outcome = run_well("study " + comparison.program, comparison.arguments, "comparison");
    CHECK(files_in(outcome.directory) == expected_files(comparison, has_gnuplot()));
    const auto summary = read_summary(outcome);
    CHECK(summary["program"] == comparison.program);
    for (const auto& [scheme, figures] : summary["schemes"].items()) {
        CAPTURE(scheme);
        CHECK(outcome.out.find(scheme) != std::string::npos);
        for (const char* name : {"steps", "dt", "energy_error_relative", "drift_relative", "excess_relative",
                                 "parasitic_max", "force_evaluations", "seconds"})
            CHECK(figures[name].is_number());
    }
}

TEST_CASE("a comparison without gnuplot says so and leaves all but the picture", "[programs]") {
    const Comparison& comparison = GENERATE(from_range(comparisons));
    const auto outcome =
        run_well("study " + comparison.program, comparison.arguments, "comparison_no_gnuplot", "PATH=/nowhere");
    CHECK(outcome.out.find("gnuplot is not installed") != std::string::npos);
    CHECK(files_in(outcome.directory) == expected_files(comparison, false));
}

TEST_CASE("a comparison removes what an earlier one left, and nobody else's file", "[programs]") {
    const Comparison& comparison = GENERATE(from_range(comparisons));
    CAPTURE(comparison.program);
    const auto all = run_well("study " + comparison.program, comparison.arguments, "comparison_twice");
    std::ofstream(all.directory / "notes.csv") << "mine\n";
    std::ofstream(all.directory / "memm.csv.partial") << "broken off\n";
    const auto again =
        run_program("study " + comparison.program,
                    fmt::format("{} --integrator memm --out '{}'", comparison.arguments, all.directory.string()), "");
    REQUIRE(again.exit_code == 0);
    CHECK_FALSE(fs::exists(all.directory / "leapfrog.csv"));
    CHECK_FALSE(fs::exists(all.directory / "memm.csv.partial"));
    CHECK(read_text(all.directory / "notes.csv") == "mine\n");
    CHECK(read_summary(all)["schemes"].size() == 1);
}

TEST_CASE("the rows of a comparison's files are as far apart as asked for, the first and the last node among them",
          "[programs]") {
    const auto outcome = run_well("study fpu", "--dt 0.01 --time 1.05 --interval 10 --integrator memm", "comparison_rows");
    const auto time = read_table(outcome, "memm.csv").column("time");
    REQUIRE(time.size() == 12);
    CHECK(time.front() == 0.0);
    CHECK(time[1] == Approx(0.1));
    CHECK(time.back() == Approx(1.05));
}
