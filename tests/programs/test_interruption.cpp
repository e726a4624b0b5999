// Runs that end before their last step: asked to by a signal, or killed.
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/support/signals.hpp"
#include "programs/child.hpp"
#include "programs/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace abut;
using namespace abut::test::programs;

std::vector<std::string> long_detection(const fs::path& out) {
    return {"detect",     "torus:n=500", "torus:n=500,x=2.6", "--translate", "1:-0.5,0,0", "--steps", "100000000",
            "--distance", "0.3",         "--write-every",     "3",           "--threads",  "1",       "--out",
            out.string()};
}

void (*action_of(int signal))(int) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    return action.sa_handler;
}

}  // namespace

TEST_CASE("a run ends after its present step at SIGINT and SIGTERM, with all its files and the code of the signal",
          "[programs][interruption]") {
    const int signal = GENERATE(SIGINT, SIGTERM);
    const Folder folder("interrupted");
    Child child("abut", long_run(folder.path()));
    child.wait_until([&] { return lines_in(folder.path() / "energy.csv.partial") > 5; });
    child.send(signal);
    CHECK(child.wait() == 128 + signal);

    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = folder.path(), .folder = nullptr};
    const auto summary = read_summary(outcome);
    CHECK(summary["complete"] == false);
    const auto steps = read_energies(outcome).column("step");
    CHECK(steps.back() == summary["steps"].get<double>());
    CHECK(read_energies(outcome).column("time").back() == summary["time"].get<double>());
    CHECK(steps.back() < 1e8);
    CHECK(steps[1] == 7.0);
    for (const char* name : {"energy.svg", "bodies.pvd", "bodies_surface.pvd"}) CHECK(fs::exists(folder.path() / name));
    CHECK_FALSE(any_partial(folder.path()));
}

TEST_CASE("a run that comes to its end says that it is complete", "[programs][interruption]") {
    CHECK(read_summary(run_well("abut", slip("--set values.size=0.3 --steps 3 --frames 0"), "complete"))["complete"] ==
          true);
    CHECK(read_summary(run_well("abut", "detect torus torus:x=2.6", "complete"))["complete"] == true);
}

TEST_CASE("detect: a run ends after its present step at SIGINT and SIGTERM, and that step is written as the last one",
          "[programs][detect][interruption]") {
    const int signal = GENERATE(SIGINT, SIGTERM);
    const Folder folder("interrupted_detection");
    Child child("abut", long_detection(folder.path()));
    child.wait_until([&] { return lines_in(folder.path() / "steps.csv.partial") > 5; });
    child.send(signal);
    CHECK(child.wait() == 128 + signal);

    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = folder.path(), .folder = nullptr};
    const auto summary = read_summary(outcome);
    CHECK(summary["complete"] == false);
    const int last = summary["last_step"]["step"];
    CHECK(summary["steps"] == last);
    CHECK(read_table(outcome, "steps.csv").column("step").back() == last);
    CHECK(read_table(outcome, "overlaps.csv").column("step").back() == last);
    CHECK(fs::exists(folder.path() / fmt::format("surface_{:06}.vtp", last)));
    CHECK_FALSE(any_partial(folder.path()));
}

TEST_CASE("detect: a run that is killed leaves the rows of all steps but the one under way",
          "[programs][detect][interruption]") {
    const Folder folder("killed_detection");
    Child child("abut", long_detection(folder.path()));
    child.wait_until([&] { return fs::exists(folder.path() / "overlaps_000009.vtp"); });
    child.send(SIGKILL);
    CHECK(child.wait() == -SIGKILL);
    CHECK(lines_in(folder.path() / "steps.csv.partial") >= 10);  // names of the columns, steps 0 to 8
    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = folder.path(), .folder = nullptr};
    for (const char* name : {"candidates.csv.partial", "overlaps.csv.partial"}) {
        const auto steps = read_table(outcome, name).column("step");
        for (const double step : {0.0, 3.0, 6.0}) CHECK(std::ranges::count(steps, step) > 0);
    }
    CHECK_FALSE(fs::exists(folder.path() / "steps.csv"));
}

TEST_CASE("the first signal is noted, one that comes with it is the same, and a later one ends the process",
          "[programs][interruption]") {
    const auto before = action_of(SIGINT);
    {
        const apps::StopSignals signals;
        CHECK(action_of(SIGTERM) != SIG_DFL);
        std::raise(SIGINT);
        CHECK(apps::noted_signal() == SIGINT);
        CHECK(apps::StopOnSignal<2>().asks_to_stop());
        std::raise(SIGINT);  // as timeout(1) does
        const pid_t later = fork();
        if (later == 0) {
            usleep(600'000);
            std::raise(SIGTERM);
            _exit(0);
        }
        int status = 0;
        REQUIRE(waitpid(later, &status, 0) == later);
        CHECK(WIFSIGNALED(status));
    }
    CHECK(action_of(SIGINT) == before);

    std::signal(SIGINT, SIG_IGN);
    {
        const apps::StopSignals signals;
        CHECK(action_of(SIGINT) == SIG_IGN);
        CHECK(action_of(SIGTERM) != SIG_IGN);
    }
    std::signal(SIGINT, before);
}
