#include "apps/abut/restart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "abut/base/error.hpp"
#include "abut/base/input_file.hpp"
#include "abut/base/text.hpp"
#include "abut/input/changes.hpp"
#include "abut/input/fault.hpp"
#include "abut/run/files/checkpoint_folder.hpp"

namespace abut::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene_name = "scene.toml";
constexpr const char* command_name = "restart.json";

using Json = nlohmann::ordered_json;

fs::path checkpoints_of(const fs::path& results) { return results / "checkpoints"; }

/// JSON of words from a command line: as text, or byte by byte where they are no UTF-8.
Json json_of(const std::string& word) {
    return as_utf8(word) == word ? Json(word) : Json(std::vector<unsigned char>(word.begin(), word.end()));
}

std::string text_in(const Json& json) {
    if (json.is_string()) return json.get<std::string>();
    const auto bytes = json.get<std::vector<unsigned char>>();
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> files_for_restart(const Restart& restart, const fs::path& copy) {
    const std::string scene = file_bytes(copy);
    Json command = {{"scene", json_of(restart.scene.string())}, {"arguments", Json::array()}};
    for (const std::string& argument : restart.arguments) command["arguments"].push_back(json_of(argument));
    if (restart.until) command["until"] = *restart.until;
    return {{scene_name, scene}, {command_name, command.dump(2) + "\n"}};
}

Restart read_restart(const fs::path& results) {
    const run::CheckpointFolder folder(checkpoints_of(results));
    if (folder.is_empty()) static_cast<void>(folder.last());  // which says so
    const auto command = Json::parse(folder.text(command_name), nullptr, false);
    try {
        Restart restart{text_in(command.at("scene")), {}};
        for (const Json& argument : command.at("arguments")) restart.arguments.push_back(text_in(argument));
        if (command.contains("until")) restart.until = command.at("until").get<double>();
        if (!restart.arguments.empty()) return restart;
    } catch (const nlohmann::json::exception&) {
    }
    throw BadInput(fmt::format("{}: damaged. Repeat the command of the run with --resume and --out {}.",
                               (folder.directory() / command_name).string(), results.string()));
}

std::string changes_since(const fs::path& scene, const fs::path& results) {
    constexpr std::size_t most_said = 5;
    const fs::path before = scene_for_restart(results);
    if (std::error_code error; !fs::exists(before, error)) return "";
    std::vector<std::string> changes;
    try {
        changes = input::changed_keys(before, scene);
    } catch (const input::SceneError&) {
        return fmt::format("{}: the scene has changed since the run began, and cannot be read any more.", scene.string());
    }
    if (changes.empty()) return "";
    std::string text = fmt::format("{}: the scene has changed since the run began: ", scene.string());
    for (std::size_t i = 0; i < std::min(changes.size(), most_said); ++i) text += (i == 0 ? "" : "; ") + changes[i];
    return text + (changes.size() > most_said ? fmt::format("; and {} more.", changes.size() - most_said) : ".");
}

fs::path scene_for_restart(const fs::path& results) { return checkpoints_of(results) / scene_name; }

}  // namespace abut::apps
