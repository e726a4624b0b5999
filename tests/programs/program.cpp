#include "programs/program.hpp"

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
#include <tuple>

namespace abut::test::programs {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> parts;
    std::istringstream stream(line);
    for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
    return parts;
}

}  // namespace

Folder::Folder(const std::string& name) : path_(fs::path(ABUT_PROGRAM_RESULTS) / fmt::format("{}.{}", name, getpid())) {
    fs::remove_all(path_);
    fs::create_directories(path_);
}

Folder::~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

Outcome run_program(const std::string& program, const std::string& arguments, const std::string& folder,
                    const std::string& before) {
    const Folder streams(folder + ".streams");
    const auto out = streams.path() / "out", error = streams.path() / "error";
    const auto results = folder.empty() ? nullptr : std::make_shared<const Folder>(folder);
    const auto directory = results ? results->path() : fs::path();
    const std::string to = results ? fmt::format("--out '{}'", directory.string()) : "";
    const int status = std::system(fmt::format("{} '{}'/{} {} {} >'{}' 2>'{}' </dev/null", before, ABUT_PROGRAM_FOLDER,
                                               program, arguments, to, out.string(), error.string())
                                       .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(error), directory, results};
}

Outcome run_well(const std::string& program, const std::string& arguments, const std::string& folder,
                 const std::string& before) {
    Outcome outcome = run_program(program, arguments, folder, before);
    INFO(program << " " << arguments << "\n" << outcome.error);
    REQUIRE(outcome.exit_code == 0);
    return outcome;
}

std::string slip(const std::string& options) {
    return fmt::format("run '{}/slipping_cylinders.toml' {}", ABUT_SCENES, options);
}

std::string slip_3d(const std::string& options) {
    return fmt::format("run '{}/slipping_cylinders_3d.toml' {}", ABUT_SCENES, options);
}

std::string two_meshes(int dim, const fs::path& left, const fs::path& right, const std::string& options) {
    const fs::path scene = left.parent_path() / "two_meshes.toml";
    std::ofstream file(scene);
    file << fmt::format("dim = {}\n[contact]\nlaw = \"reconstruction\"\n[materials.one]\nyoung = 1\ndensity = 1\n", dim);
    for (const auto& [name, mesh, speed] : {std::tuple("left", left, 0.05), std::tuple("right", right, -0.05)})
        file << fmt::format("[bodies.{}]\nmesh = '{}'\nmaterial = \"one\"\nvelocity = [{}, 0{}]\n", name, mesh.string(),
                            speed, dim == 2 ? "" : ", 0");
    return fmt::format("run '{}' {}", scene.string(), options);
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path.string() + " is missing");
    return {std::istreambuf_iterator<char>(file), {}};
}

nlohmann::json read_summary(const Outcome& outcome) {
    return nlohmann::json::parse(read_text(outcome.directory / "summary.json"));
}

double figure(const Outcome& outcome, const std::string& scheme, const std::string& name) {
    return read_summary(outcome).at("schemes").at(scheme).at(name).get<double>();
}

StudyQuantity study_quantity(const Outcome& outcome, std::size_t level, const std::string& name) {
    const nlohmann::json summary = read_summary(outcome);
    for (const auto& quantity : summary["levels"][level]["quantities"])
        if (quantity["name"] == name)
            return {quantity["value"].get<double>(), quantity["reference"].get<double>(), quantity["error"].get<double>()};
    throw std::runtime_error("level " + std::to_string(level) + " of " + summary["program"].get<std::string>() +
                             " has no quantity '" + name + "'");
}

int check_targets(const Outcome& outcome) {
    int n = 0;
    const auto summary = read_summary(outcome);
    for (const auto& level : summary["levels"])
        for (const auto& quantity : level["quantities"]) {
            if (!quantity.contains("met")) continue;
            CAPTURE(level["name"].get<std::string>(), quantity.dump());
            CHECK(quantity["met"].get<bool>());
            CHECK(quantity["error"].get<double>() <= quantity["allowed"].get<double>());
            ++n;
        }
    return n;
}

std::vector<std::string> files_in(const fs::path& directory) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory)) {
        const std::string name = entry.path().filename().string();
        if (name == "frames")
            for (const auto& frame : fs::directory_iterator(entry))
                names.push_back(name + "/" + frame.path().filename().string());
        else if (name != ".abut.results")
            names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

std::vector<double> Table::column(const std::string& name) const {
    const auto place = std::ranges::find(columns, name) - columns.begin();
    std::vector<double> values;
    for (const auto& row : rows) values.push_back(row.at(static_cast<std::size_t>(place)));
    return values;
}

Table read_energies(const Outcome& outcome) { return read_table(outcome, "energy.csv"); }

Table read_table(const Outcome& outcome, const std::string& file) {
    std::istringstream text(read_text(outcome.directory / file));
    Table table;
    std::string line;
    std::getline(text, line);
    for (const std::string& column : split(line)) table.columns.push_back(column.substr(0, column.find(" [")));
    while (std::getline(text, line)) {
        table.rows.emplace_back();
        for (const std::string& value : split(line)) table.rows.back().push_back(std::stod(value));
    }
    return table;
}

double relative_drift(const Outcome& outcome) {
    const auto summary = read_summary(outcome);
    return summary["pseudo_energy_drift"].get<double>() / summary["energy_scale"]["value"].get<double>();
}

}  // namespace abut::test::programs
