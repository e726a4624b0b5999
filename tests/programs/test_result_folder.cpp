// A folder of results belongs to one run.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <string>
#include <vector>

#include "abut/run/files/folder_lock.hpp"
#include "programs/child.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut;
using namespace abut::test::programs;
using Catch::Contains;

}  // namespace

TEST_CASE("a second run into the folder of one that is under way is refused and changes nothing there, until that is killed",
          "[programs][folder]") {
    const Folder folder("two_runs");
    Child first("abut", long_run(folder.path()));
    first.wait_until([&] { return lines_in(folder.path() / "energy.csv.partial") > 5; });
    const auto before = files_in(folder.path());
    const std::string again =
        fmt::format("--set values.size=0.3 --steps 3 --frames 0 --cfl 0.2 --out '{}'", folder.path().string());
    const Outcome refused = run_program("abut", slip(again), "");
    CHECK(refused.exit_code == 1);
    CHECK_THAT(refused.error,
               Contains(fmt::format("slipping_cylinders, process {}, since", first.id())) && Contains("--out"));
    CHECK(files_in(folder.path()) == before);

    first.send(SIGKILL);
    CHECK(first.wait() == -SIGKILL);
    CHECK(run_program("abut", slip(again), "").exit_code == 0);
    CHECK_FALSE(any_partial(folder.path()));
}

TEST_CASE("every program that leaves results is refused a folder that another run has", "[programs][folder]") {
    const auto [program, arguments] =
        GENERATE(table<std::string, std::string>({{"abut", slip("--steps 1")},
                                                  {"study bouncing_strip", "--steps 1"},
                                                  {"abut", "detect torus"},
                                                  {"study fpu", "--time 1"},
                                                  {"study slow_fast_wave", "--cells 100 --refinements 0"},
                                                  {"study bouncing_bar", "--cells 10"},
                                                  {"study trade", "--only bar --levels 1"},
                                                  {"study extremes", "--only rest --quick"},
                                                  {"study two_bars", ""},
                                                  {"study spectrum", ""},
                                                  {"study bulk_patch", ""}}));
    CAPTURE(program);
    const Folder folder("taken");
    const run::FolderLock lock(folder.path(), "the test");
    const Outcome outcome = run_program(program, fmt::format("{} --out '{}'", arguments, folder.path().string()), "");
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.error, Contains("another run writes to this folder: the test, process") && Contains("--out"));
    CHECK(files_in(folder.path()) == std::vector<std::string>{".abut.lock"});
}
