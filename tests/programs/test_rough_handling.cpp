// Programs whose streams are closed or broken, whose folders hold files of others, and whose names are no text.
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "programs/child.hpp"
#include "programs/program.hpp"

namespace {

namespace fs = std::filesystem;
using namespace abut::test::programs;
using Catch::Contains;

std::string program(const std::string& name) { return fmt::format("'{}'/{}", ABUT_PROGRAM_FOLDER, name); }

/// The exit code of a line that bash runs.
int shell(const std::string& line, const fs::path& folder) {
    const fs::path script = folder / "line.sh";
    std::ofstream(script) << line << "\n";
    const int status = std::system(fmt::format("bash '{}'", script.string()).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

const std::string short_run = slip("--set values.size=0.3 --steps 20 --frames 0 --interval 1 --threads 1");

}  // namespace

TEST_CASE("with its standard streams closed a run leaves the files that it leaves with open ones", "[programs][streams]") {
    const auto open = run_well("abut", short_run, "streams_open");
    const Folder folder("streams_closed");
    const fs::path out = folder.path() / "out";
    const std::string closed = GENERATE(std::string("<&- >&- 2>&-"), std::string("<&- >&-"), std::string("<&- >/dev/null"));
    CHECK(shell(fmt::format("{} {} --out '{}' {}", program("abut"), short_run, out.string(), closed), folder.path()) == 0);
    CHECK(read_text(out / "energy.csv") == read_text(open.directory / "energy.csv"));
    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = out, .folder = nullptr};
    CHECK(read_summary(outcome)["complete"] == true);
    CHECK(files_in(out) == files_in(open.directory));
}

TEST_CASE("a run at the limit of file sizes ends by an error that names the file, not by a signal", "[programs][streams]") {
    const Folder folder("file_limit");
    const fs::path error = folder.path() / "error";
    // energy.csv has some 2000 rows of 300 bytes; 40 blocks of 1024 bytes are allowed
    const std::string line = fmt::format("ulimit -c 0; ulimit -f 40; {} {} --out '{}' >/dev/null 2>'{}'", program("abut"),
                                         slip("--set values.size=0.3 --steps 2000 --frames 0 --interval 1 --threads 1"),
                                         (folder.path() / "out").string(), error.string());
    CHECK(shell(line, folder.path()) == 1);
    CHECK_THAT(read_text(error), Contains("energy.csv") && Contains("cannot be written") && Contains("ulimit -f"));
}

TEST_CASE("a run whose output nobody reads goes on to its end, and says so", "[programs][streams]") {
    const Folder folder("streams_pipe");
    const fs::path out = folder.path() / "out", error = folder.path() / "error";
    const std::string how = GENERATE(std::string(""), std::string("--json"));
    const std::string line =
        fmt::format("set -o pipefail; {} {} --steps 2000 {} --out '{}' 2>'{}' | true", program("abut"),
                    slip("--set values.size=0.3 --frames 0 --interval 1 --threads 1"), how, out.string(), error.string());
    CHECK(shell(line, folder.path()) == 0);
    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = out, .folder = nullptr};
    CHECK(read_summary(outcome)["complete"] == true);
    CHECK(read_summary(outcome)["steps"] == 2000);
    CHECK_FALSE(any_partial(out));
    CHECK_THAT(read_text(error), Contains("nobody reads"));
}

TEST_CASE("SIGHUP ends a run as SIGTERM does, with all its files", "[programs][interruption]") {
    const Folder folder("hung_up");
    Child child("abut", long_run(folder.path()));
    child.wait_until([&] { return lines_in(folder.path() / "energy.csv.partial") > 5; });
    child.send(SIGHUP);
    CHECK(child.wait() == 128 + SIGHUP);
    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = folder.path(), .folder = nullptr};
    CHECK(read_summary(outcome)["complete"] == false);
    CHECK_FALSE(any_partial(folder.path()));
}

TEST_CASE("a user's own file in the folder of --out stays, and the run is refused by its name", "[programs][folder]") {
    const auto [name, arguments, file] =
        GENERATE(table<std::string, std::string, std::string>({{"abut", short_run, "summary.json"},
                                                               {"abut", short_run, "energy.csv"},
                                                               {"abut", short_run, "failed.csv"},
                                                               {"abut", short_run, "frames/bodies_000003.vtu"},
                                                               {"abut", "detect torus:n=500", "overlaps.csv"},
                                                               {"study bouncing_bar", "--cells 10", "bouncing_bar.png"},
                                                               {"study trade", "--only bar --levels 1", "trade.csv"}}));
    CAPTURE(name, file);
    const Folder folder("own_files");
    fs::create_directories((folder.path() / file).parent_path());
    write(folder.path() / file, "mine");
    const auto outcome = run_program(name, fmt::format("{} --out '{}'", arguments, folder.path().string()), "");
    CHECK(outcome.exit_code == 1);
    CHECK_THAT(outcome.error, Contains(file + " is there") && Contains("--out"));
    CHECK(read_text(folder.path() / file) == "mine");
    CHECK(files_in(folder.path()) == std::vector<std::string>{file});
}

TEST_CASE("a run in the folder of an earlier one replaces its results and nothing else", "[programs][folder]") {
    const Folder folder("again");
    const std::string arguments = fmt::format("{} --out '{}'", short_run, folder.path().string());
    REQUIRE(run_program("abut", arguments, "").exit_code == 0);
    write(folder.path() / "notes.txt", "mine");
    write(folder.path() / "energies.csv", "mine");
    CHECK(run_program("abut", arguments, "").exit_code == 0);
    CHECK(read_text(folder.path() / "notes.txt") == "mine");
    CHECK(read_text(folder.path() / "energies.csv") == "mine");
}

TEST_CASE("a folder whose name is no UTF-8 gets all results of a run", "[programs][folder]") {
    const Folder folder("bytes");
    const auto [name, arguments] = GENERATE(table<std::string, std::string>(
        {{"abut", short_run}, {"abut", "detect torus:n=500"}, {"study bouncing_bar", "--cells 10"}}));
    CAPTURE(name);
    const fs::path out = folder.path() / "K\xF6rper";
    CHECK(shell(fmt::format("{} {} --out '{}' >/dev/null 2>/dev/null", program(name), arguments, out.string()),
                folder.path()) == 0);
    const Outcome outcome{.exit_code = 0, .out = "", .error = "", .directory = out, .folder = nullptr};
    CHECK_THAT(read_summary(outcome)["options"]["out"].get<std::string>(), Contains("K\xEF\xBF\xBDrper"));
}
