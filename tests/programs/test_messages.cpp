// What programs that run scenes say: to people, to machines, or nothing.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/support/time_left.hpp"
#include "programs/child.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut;
using namespace abut::test::programs;
using Catch::Contains;
using nlohmann::json;

/// Every line is an object; throws if one is not.
std::vector<json> lines_of(const std::string& text) {
    std::vector<json> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
    return lines;
}

/// Of a file that is being written: without its last line.
std::vector<json> whole_lines_of(const std::filesystem::path& path) {
    const std::string text = std::filesystem::exists(path) ? read_text(path) : "";
    return lines_of(text.substr(0, text.rfind('\n') + 1));
}

std::vector<json> of_event(const std::vector<json>& lines, const std::string& event) {
    std::vector<json> some;
    for (const json& line : lines)
        if (line.at("event") == event) some.push_back(line);
    return some;
}

}  // namespace

TEST_CASE("with --quiet a program says nothing of a good run, and leaves the same results", "[programs][messages]") {
    const auto quiet = run_well("abut", slip("--set values.size=0.25 --steps 20 --frames 2 --quiet"), "quiet");
    CHECK(quiet.out.empty());
    CHECK(quiet.error.empty());
    const auto normal = run_well("abut", slip("--set values.size=0.25 --steps 20 --frames 2"), "normal");
    CHECK_THAT(normal.out, Contains("step 20/20") && Contains("drift of pseudo-energy"));
    CHECK(files_in(quiet.directory) == files_in(normal.directory));
    CHECK(read_text(quiet.directory / "energy.csv") == read_text(normal.directory / "energy.csv"));
}

TEST_CASE("an error is on standard error whatever a program says otherwise", "[programs][messages]") {
    const std::string bad = "--set values.size=0.25 --steps 5 --dt 1";
    const auto normal = run_program("abut", slip(bad), "bad");
    const auto quiet = run_program("abut", slip(bad + " --quiet"), "bad");
    const auto machine = run_program("abut", slip(bad + " --json"), "bad");
    for (const auto* outcome : {&normal, &quiet, &machine}) {
        CHECK(outcome->exit_code == 1);
        CHECK_THAT(outcome->error, Contains("above the stable step"));
        CHECK(outcome->error == normal.error);
    }
    CHECK(quiet.out.empty());
    const auto lines = lines_of(machine.out);
    REQUIRE(of_event(lines, "error").size() == 1);
    CHECK(lines.back()["kind"] == "bad input");
    CHECK(lines.back()["exit_code"] == 1);
    CHECK("abut: error: " + lines.back()["text"].get<std::string>() + "\n" == normal.error);
}

TEST_CASE("with --json a program tells a run line by line, in the figures of its files", "[programs][messages]") {
    const auto outcome = run_well("abut", slip("--set values.size=0.25 --steps 20 --interval 5 --frames 0 --json"), "lines");
    CHECK(outcome.error.empty());
    const auto lines = lines_of(outcome.out);
    const auto summary = read_summary(outcome);
    CHECK(lines.front()["event"] == "start");
    CHECK(lines.front()["cells"] == summary["cells"]);
    CHECK(lines.front()["dt"] == summary["dt"]);
    CHECK(lines.front()["bodies"] == json({"left", "right"}));
    CHECK(lines.back()["event"] == "end");
    for (const char* same : {"complete", "steps", "time", "pseudo_energy_drift", "energy_drift", "energy_excess_max",
                             "parasitic_max", "events", "missed_contacts"})
        CHECK(lines.back()[same] == summary[same]);
    CHECK(lines.back()["exit_code"] == 0);
    const auto records = of_event(lines, "record");
    const auto energies = read_energies(outcome);
    REQUIRE(records.size() == energies.rows.size());
    for (std::size_t row = 0; row < records.size(); ++row)
        for (std::size_t column = 0; column < energies.columns.size(); ++column)
            CHECK(records[row][energies.columns[column]] == energies.rows[row][column]);
    const auto progress = of_event(lines, "progress");
    REQUIRE_FALSE(progress.empty());
    CHECK(progress.back()["step"] == 20);
    CHECK(progress.back()["seconds_left"] == 0.0);
}

TEST_CASE("with --json a program tells of warnings, and of the code with which a signal ends a run",
          "[programs][messages]") {
    const auto warned =
        run_well("abut", slip("--set values.size=0.25 --steps 20 --interval 10 --restart 10 --frames 0 --json"), "warned");
    const auto warnings = of_event(lines_of(warned.out), "warning");
    CHECK(std::ranges::count_if(warnings, [](const json& line) {
              return line["severity"] == "warning" && line["value"] == 10.0 && line["threshold"] == 10.0;
          }) == 1);

    const Folder folder("stopped");
    std::filesystem::create_directories(folder.path());
    const auto said = folder.path() / "said.jsonl";
    std::vector<std::string> arguments = long_run(folder.path() / "results");
    arguments.push_back("--json");
    Child child("abut", arguments, said);
    child.wait_until([&] { return of_event(whole_lines_of(said), "progress").size() >= 2; });
    child.send(SIGTERM);
    CHECK(child.wait() == 143);
    const auto lines = lines_of(read_text(said));
    CHECK(lines.back()["event"] == "end");
    CHECK(lines.back()["complete"] == false);
    CHECK(lines.back()["exit_code"] == 143);
    const auto progress = of_event(lines, "progress");
    REQUIRE(progress.size() >= 2);
    for (std::size_t i = 1; i < progress.size(); ++i) CHECK(progress[i]["step"] > progress[i - 1]["step"]);
}

TEST_CASE("a program is told to be quiet or to speak to machines, not both", "[programs][messages]") {
    const auto outcome = run_program("abut", slip("--quiet --json"), "both");
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.error, Contains("--quiet") && Contains("--json"));
    CHECK(files_in(outcome.directory).empty());
}

TEST_CASE("abut has --quiet and --json, for faults of a scene as well", "[programs][messages][abut]") {
    const std::string scene = fmt::format("run '{}/slipping_cylinders.toml' --steps 3 --frames 0", ABUT_SCENES);
    const auto good = run_well("abut", scene + " --json", "abut_lines");
    CHECK(lines_of(good.out).front()["program"] == "slipping_cylinders");
    CHECK(run_well("abut", scene + " --quiet", "abut_quiet").out.empty());
    const std::string sweep = scene + " --sweep run.cfl=0.5,0.9";
    CHECK(run_well("abut", sweep + " --quiet", "sweep_quiet").out.empty());
    CHECK(of_event(lines_of(run_well("abut", sweep + " --json", "sweep_lines").out), "end").size() == 2);
    const auto bad = run_program("abut", scene + " --json --set bodies.left.yuong=1", "abut_lines");
    CHECK(bad.exit_code == 1);
    const auto lines = lines_of(bad.out);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0]["event"] == "error");
    CHECK_THAT(lines[0]["text"].get<std::string>(), Contains("'young'"));
}

TEST_CASE("the time left is that of steps as long as the last ones", "[programs][messages]") {
    apps::TimeLeft even(1000);
    CHECK(even.seconds() == 0.0);
    for (int step = 1; step <= 400; ++step) even.add(step, 0.25 * step);
    CHECK(even.seconds() == Approx(0.25 * 600));

    apps::TimeLeft slower(1000);  // steps of 0.1 s, and from step 100 on of 1 s
    for (int step = 1; step <= 100; ++step) slower.add(step, 0.1 * step);
    CHECK(slower.seconds() == Approx(0.1 * 900));
    for (int step = 101; step <= 200; ++step) slower.add(step, 10.0 + (step - 100));
    CHECK(slower.seconds() == Approx(800.0).epsilon(0.02));  // the mean of all would say 440

    apps::TimeLeft done(3);
    done.add(3, 1.0);
    CHECK(done.seconds() == 0.0);
}

TEST_CASE("durations are said in the units that people take", "[programs][messages]") {
    CHECK(apps::duration(4.24) == "4.2 s");
    CHECK(apps::duration(99.94) == "99.9 s");
    CHECK(apps::duration(99.96) == "1 min 40 s");
    CHECK(apps::duration(725.0) == "12 min 05 s");
    CHECK(apps::duration(11220.0) == "3 h 07 min");
    CHECK(apps::duration(190800.0) == "2 d 05 h");
}
