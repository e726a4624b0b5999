#include "examples/program.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace abut::examples::test {
namespace {

namespace fs = std::filesystem;

/// A folder for this process alone: CTest runs the cases side by side.
fs::path own_folder(const std::string& folder) { return fs::path(ABUT_EXAMPLE_RESULTS) / fmt::format("{}.{}", folder, getpid()); }

struct TemporaryFiles {
    fs::path out, error;
    explicit TemporaryFiles(const std::string& name) : out(own_folder(name + ".stdout")), error(own_folder(name + ".stderr")) {
        fs::create_directories(out.parent_path());
    }
    TemporaryFiles(const TemporaryFiles&) = delete;
    TemporaryFiles& operator=(const TemporaryFiles&) = delete;
    ~TemporaryFiles() {
        std::error_code ignored;
        fs::remove(out, ignored);
        fs::remove(error, ignored);
    }
};

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> parts;
    std::istringstream stream(line);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

}  // namespace

Outcome run_program(const std::string& program, const std::string& arguments, const std::string& folder, const std::string& environment) {
    const TemporaryFiles files(folder.empty() ? program : folder);
    const fs::path directory = own_folder(folder);
    if (!folder.empty()) fs::remove_all(directory);
    const std::string out = folder.empty() ? "" : fmt::format("--out '{}'", directory.string());
    const int status = std::system(fmt::format("{} '{}/{}' {} {} >'{}' 2>'{}' </dev/null", environment, ABUT_EXAMPLE_PROGRAMS, program, arguments, out,
                                               files.out.string(), files.error.string())
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(files.out), read_text(files.error), directory};
}

Outcome run_well(const std::string& program, const std::string& arguments, const std::string& folder, const std::string& environment) {
    Outcome outcome = run_program(program, arguments, folder, environment);
    INFO(program << " " << arguments << "\n" << outcome.error);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path.string() + " is missing");
    return {std::istreambuf_iterator<char>(file), {}};
}

nlohmann::json read_summary(const Outcome& outcome) { return nlohmann::json::parse(read_text(outcome.directory / "summary.json")); }

std::vector<double> Table::column(const std::string& name) const {
    const auto place = std::ranges::find(columns, name) - columns.begin();
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row.at(static_cast<std::size_t>(place)));
    return values;
}

Table read_energies(const Outcome& outcome) {
    std::istringstream text(read_text(outcome.directory / "energy.csv"));
    Table table;
    std::string line;
    std::getline(text, line);
    table.columns = split(line);
    while (std::getline(text, line)) {
        table.rows.emplace_back();
        for (const std::string& value : split(line)) table.rows.back().push_back(std::stod(value));
    }
    return table;
}

}  // namespace abut::examples::test
