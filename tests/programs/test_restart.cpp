// Runs that go on after they were stopped or killed.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "programs/child.hpp"
#include "programs/program.hpp"

namespace {

using namespace abut::test::programs;
namespace fs = std::filesystem;

constexpr const char* moderate =
    "--set run.time=60 --set output.interval=5 --set output.frames=3 --set output.checkpoint_steps=50";

std::string scene(const std::string& name) { return fmt::format("{}/{}.toml", ABUT_SCENES, name); }

std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> words;
    for (std::size_t at = 0, end = 0; end != std::string::npos; at = end + 1) {
        end = text.find(' ', at);
        words.push_back(text.substr(at, end - at));
    }
    return words;
}

bool has_checkpoint(const fs::path& results) {
    std::error_code none_yet;
    for (const auto& entry : fs::directory_iterator(results / "checkpoints", none_yet))
        if (entry.path().extension() == ".h5") return true;
    return false;
}

/// Runs a scene, and stops it by a signal once it has a checkpoint; with another argument from there on.
void run_until_checkpoint(const fs::path& results, const std::string& toml, int signal) {
    std::vector<std::string> arguments{"run", toml, "--out", results.string()};
    for (const std::string& word : words(moderate)) arguments.push_back(word);
    Child child("abut", arguments);
    child.wait_until([&] { return has_checkpoint(results); });
    child.send(signal);
    CHECK(child.wait() == (signal == SIGKILL ? -SIGKILL : 128 + signal));
}

}  // namespace

TEST_CASE("abut restart gives the energies of the run that nobody stopped or killed", "[programs][abut][restart]") {
    const int signal = GENERATE(SIGTERM, SIGKILL);
    const auto whole = run_well("abut", fmt::format("run '{}' {}", scene("slipping_cylinders"), moderate), "whole");
    const Folder folder("stopped");
    run_until_checkpoint(folder.path(), fs::relative(scene("slipping_cylinders")).string(), signal);
    const auto rest = run_program("abut", fmt::format("restart '{}' --threads 1", folder.path().string()), "");
    CAPTURE(rest.error);
    REQUIRE(rest.exit_code == 0);
    CHECK(read_text(folder.path() / "energy.csv") == read_text(whole.directory / "energy.csv"));
    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = folder.path(), .folder = nullptr};
    const auto summary = read_summary(outcome);
    CHECK(summary["complete"] == true);
    CHECK(summary["resumed_after"] > 0);
    CHECK(summary["program"] == "slipping_cylinders");
    CHECK_FALSE(fs::exists(folder.path() / "checkpoints"));
    CHECK_FALSE(any_partial(folder.path()));

    const auto again = run_program("abut", fmt::format("restart '{}'", folder.path().string()), "");
    CHECK(again.exit_code == 1);
    CHECK(again.error.find("no checkpoint that a run can go on from") != std::string::npos);
}

TEST_CASE("a restart takes the scene as it was, with its files where they were", "[programs][abut][restart]") {
    const Folder home("scene_home"), results("scene_results");
    const fs::path mine = home.path() / "mine.toml";
    fs::copy_file(scene("slipping_cylinders"), mine);
    run_until_checkpoint(results.path(), mine.string(), SIGKILL);
    std::ofstream(mine) << "this is no scene any more\n";
    const auto rest = run_program("abut", fmt::format("restart '{}' --json", results.path().string()), "");
    CAPTURE(rest.error);
    CHECK(rest.exit_code == 0);
    std::istringstream lines(rest.out);
    for (std::string line; std::getline(lines, line);) CHECK(nlohmann::json::parse(line).contains("event"));
    CHECK(fs::exists(results.path() / "summary.json"));
}

TEST_CASE("a run goes on with --resume, and refuses other options", "[programs][restart]") {
    const std::string options = "--set values.size=0.3 --steps 400 --frames 0 --interval 10 --checkpoint-steps 30";
    const Folder folder("resumed");
    {
        std::vector<std::string> arguments = long_run(folder.path());
        arguments.insert(arguments.end(), {"--checkpoint-steps", "30"});
        Child child("abut", arguments);
        child.wait_until([&] { return has_checkpoint(folder.path()); });
        child.send(SIGKILL);
        CHECK(child.wait() == -SIGKILL);
    }
    const auto other = run_program("abut", slip(fmt::format("{} --resume --out '{}'", options, folder.path().string())), "");
    CHECK(other.exit_code == 1);
    CHECK(other.error.find("the checkpoint is of a run with steps = 100000000, and this one has 400") != std::string::npos);
    CHECK(has_checkpoint(folder.path()));
}

TEST_CASE("a checkpoint that cannot be written ends the run with a message, and those before it stay",
          "[programs][restart]") {
    const auto outcome = run_program("abut", slip("--set values.size=0.1 --frames 0 --interval 1000 --checkpoint-steps 5"),
                                     "checkpoint_fills_up", "trap '' XFSZ; ulimit -f 16;");
    CHECK(outcome.exit_code == 1);
    for (const char* word : {"step_000000000005.h5.partial", "cannot be written", "free space"})
        CHECK(outcome.error.find(word) != std::string::npos);
    CHECK_FALSE(has_checkpoint(outcome.directory));
    auto left = files_in(outcome.directory / "checkpoints");
    std::ranges::sort(left);
    CHECK(left == std::vector<std::string>{"restart.json", "scene.toml"});  // what a restart begins from
}

TEST_CASE("a run goes on to a later end, with the energies of the run that had that end at once",
          "[programs][abut][restart]") {
    const std::string common = "--set output.interval=5 --set output.frames=3 --set output.checkpoint_steps=50";
    const auto late =
        run_well("abut", fmt::format("run '{}' --set run.time=60 {}", scene("slipping_cylinders"), common), "later_end");
    const Folder folder("earlier_end");
    const bool ended = GENERATE(true, false);
    std::vector<std::string> arguments{"run", scene("slipping_cylinders"), "--out", folder.path().string(), "--time",
                                       "30",  "--keep-last-checkpoint"};
    for (const std::string& word : words(common)) arguments.push_back(word);
    {
        Child child("abut", arguments);
        if (!ended) {
            child.wait_until([&] { return has_checkpoint(folder.path()); });
            child.send(SIGKILL);
        }
        CHECK(child.wait() == (ended ? 0 : -SIGKILL));
    }
    const auto rest = run_program("abut", fmt::format("restart '{}' --until 60", folder.path().string()), "");
    CAPTURE(rest.error);
    REQUIRE(rest.exit_code == 0);
    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = folder.path(), .folder = nullptr};
    CHECK(read_summary(outcome)["steps"] == read_summary(late)["steps"]);
    const Table whole = read_energies(late), parted = read_energies(outcome);
    std::size_t found = 0;
    for (const auto& row : parted.rows) found += std::ranges::count(whole.rows, row) > 0 ? 1 : 0;
    CHECK(parted.rows.back() == whole.rows.back());
    CHECK(found + 1 >= parted.rows.size());  // one more: the last row of the run that ended first
    CHECK(parted.rows.size() >= whole.rows.size());
    CHECK(lines_in(folder.path() / "bodies.pvd") > lines_in(late.directory / "bodies.pvd"));  // as far apart as they were
}

TEST_CASE("a restart to an end before its checkpoint is refused", "[programs][abut][restart]") {
    const Folder folder("too_early");
    const auto first = run_program("abut",
                                   fmt::format("run '{}' --time 20 --keep-last-checkpoint --frames 0 --out '{}'",
                                               scene("slipping_cylinders"), folder.path().string()),
                                   "");
    REQUIRE(first.exit_code == 0);
    const auto rest = run_program("abut", fmt::format("restart '{}' --until 10", folder.path().string()), "");
    CHECK(rest.exit_code == 1);
    CHECK(rest.error.find("Give a later end.") != std::string::npos);
    CHECK(has_checkpoint(folder.path()));
}

TEST_CASE("a scene that was edited since is named key by key by a restart, and refused by --resume",
          "[programs][abut][restart]") {
    const Folder home("edited_home"), results("edited_results");
    const fs::path mine = home.path() / "mine.toml";
    fs::copy_file(scene("slipping_cylinders"), mine);
    run_until_checkpoint(results.path(), mine.string(), SIGKILL);
    std::ofstream(mine, std::ios::app) << "[obstacles.far]\nshape = \"plane\"\npoint = [-100, 0]\nnormal = [1, 0]\n";
    const auto resumed = run_program(
        "abut", fmt::format("run '{}' --resume {} --out '{}'", mine.string(), moderate, results.path().string()), "");
    CHECK(resumed.exit_code == 1);
    for (const char* word : {"has changed since the run began", "obstacles is new", "abut restart"})
        CHECK(resumed.error.find(word) != std::string::npos);
    const auto rest = run_program("abut", fmt::format("restart '{}'", results.path().string()), "");
    CHECK(rest.exit_code == 0);
    for (const char* word : {"has changed since the run began", "obstacles is new", "as it was"})
        CHECK(rest.out.find(word) != std::string::npos);
}
