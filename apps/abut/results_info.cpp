#include "apps/abut/results_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/input_file.hpp"
#include "abut/mesh/io/write_vtu.hpp"
#include "apps/abut/info_lines.hpp"

namespace abut::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Json read_summary(const fs::path& path) {
    const Json summary = Json::parse(file_bytes(path), nullptr, false);
    if (!summary.is_object()) throw BadInput(fmt::format("{}: not a summary of a run: no object of JSON.", path.string()));
    return summary;
}

/// For people: lists in parentheses.
std::string shown(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    if (!value.is_array()) return value.dump();
    std::vector<std::string> parts;
    for (const Json& part : value) parts.push_back(shown(part));
    return fmt::format("({})", fmt::join(parts, ", "));
}

/// Line for what a summary has under a name, if it has it.
std::string line_of(const Json& summary, const char* key, const char* what, const char* unit = "") {
    return summary.contains(key) ? info_line(what, shown(summary.at(key)) + unit) : "";
}

std::string drift_line(const Json& summary, const char* key, const char* what) {
    if (!summary.contains(key) || !summary.contains("energy_scale")) return "";
    const Json& scale = summary.at("energy_scale");
    if (!summary.at(key).is_number() || !scale.contains("value") || !scale.contains("name")) return "";
    const double energy = scale.at("value").is_number() ? scale.at("value").get<double>() : 0.0;
    return info_line(what, fmt::format("{:.2e} of {}", energy > 0.0 ? summary.at(key).get<double>() / energy : 0.0,
                                       scale.at("name").get<std::string>()));
}

std::string verdict_line(const Json& summary) {
    if (!summary.contains("verdict") || !summary.at("verdict").is_object()) return "";
    return line_of(summary.at("verdict"), "text", "verdict");
}

std::string body_lines(const Json& summary) {
    std::string text;
    if (!summary.contains("bodies") || !summary.at("bodies").is_array()) return text;
    for (const Json& body : summary.at("bodies")) {
        if (!body.is_object() || !body.contains("name") || !body.contains("velocity_initial") ||
            !body.contains("velocity_final"))
            continue;
        text += info_line(fmt::format("body '{}'", body.at("name").get<std::string>()),
                          fmt::format("{} -> {} m/s", shown(body.at("velocity_initial")), shown(body.at("velocity_final"))));
    }
    return text;
}

std::string finished_lines(const Json& summary) {
    return line_of(summary, "program", "program") + line_of(summary, "version", "of Abut") +
           line_of(summary, "complete", "complete") + line_of(summary, "cells", "cells") +
           line_of(summary, "steps", "steps") + line_of(summary, "time", "until", " s") +
           drift_line(summary, "pseudo_energy_drift", "drift of H~") + drift_line(summary, "energy_drift", "error of H") +
           drift_line(summary, "energy_excess_max", "H - H~") + line_of(summary, "events", "contact events") +
           line_of(summary, "missed_contacts", "missed contacts") + verdict_line(summary) + body_lines(summary);
}

/// Rows of a table that a run writes as it goes.
std::string unfinished_lines(const fs::path& path) {
    std::istringstream file(file_bytes(path));
    std::string line, last;
    std::int64_t records = -1;  // the first line has the names
    while (std::getline(file, line)) ++records, last = line;
    const std::string until = records > 0 ? fmt::format(", the last of step {}", last.substr(0, last.find(','))) : "";
    return info_line("not finished", fmt::format("under way, or broken off: {} records in {}{}",
                                                 std::max<std::int64_t>(records, 0), path.filename().string(), until));
}

/// One by one, frames by their ending.
std::string file_lines(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        if (const std::string name = entry.path().filename().string(); name != mesh::frames_folder) names.push_back(name);
    std::ranges::sort(names);
    if (const fs::path of_frames = folder / mesh::frames_folder; fs::is_directory(of_frames)) {
        std::map<std::string, int> frames;
        for (const auto& entry : fs::directory_iterator(of_frames)) ++frames[entry.path().extension().string()];
        for (const auto& [extension, count] : frames)
            names.push_back(fmt::format("{} {} files in {}", count, extension, mesh::frames_folder));
    }
    return info_line("files", fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace

std::string results_info(const fs::path& folder) {
    const fs::path summary = folder / "summary.json", partial = folder / "energy.csv.partial";
    std::string text = fmt::format("{}: results of a run\n", folder.string());
    if (fs::exists(summary))
        text += finished_lines(read_summary(summary));
    else if (fs::exists(partial))
        text += unfinished_lines(partial);
    else
        throw BadInput(
            fmt::format("{}: no folder of results: neither summary.json nor energy.csv.partial is in it.", folder.string()));
    return text + file_lines(folder);
}

}  // namespace abut::apps
