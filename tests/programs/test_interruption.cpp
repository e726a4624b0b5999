// Runs that end before their last step: asked to by a signal, or killed.
#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "programs/child.hpp"
#include "programs/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace abut;
using namespace abut::test::programs;

std::vector<std::string> long_detection(const fs::path& out) {
    return {"torus:n=500", "torus:n=500,x=2.6", "--translate", "1:-0.5,0,0", "--steps", "100000000", "--distance",
            "0.3",         "--write-every",     "3",           "--threads",  "1",       "--out",     out.string()};
}

}  // namespace

TEST_CASE("detect: a run that is killed leaves the rows of all steps but the one under way",
          "[programs][detect][interruption]") {
    const Folder folder("killed_detection");
    Child child("detect", long_detection(folder.path()));
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
