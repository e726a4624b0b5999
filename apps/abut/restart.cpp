#include "apps/abut/restart.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "abut/base/error.hpp"
#include "abut/run/checkpoint_folder.hpp"

namespace abut::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene_name = "scene.toml";
constexpr const char* command_name = "restart.json";

fs::path checkpoints_of(const fs::path& results) { return results / "checkpoints"; }

}  // namespace

std::vector<std::pair<std::string, std::string>> files_for_restart(const Restart& restart) {
    std::ifstream file(restart.scene, std::ios::binary);
    const std::string scene{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw BadInput(fmt::format("{}: cannot be read any more. Put it back.", restart.scene.string()));
    const nlohmann::ordered_json command = {{"scene", restart.scene.string()}, {"arguments", restart.arguments}};
    return {{scene_name, scene}, {command_name, command.dump(2) + "\n"}};
}

Restart read_restart(const fs::path& results) {
    const run::CheckpointFolder folder(checkpoints_of(results));
    if (folder.is_empty()) static_cast<void>(folder.last());  // which says so
    const auto command = nlohmann::json::parse(folder.text(command_name), nullptr, false);
    try {
        return {command.at("scene").get<std::string>(), command.at("arguments").get<std::vector<std::string>>()};
    } catch (const nlohmann::json::exception&) {
        throw BadInput(fmt::format("{}: damaged. Repeat the command of the run with --resume and --out {}.",
                                   (folder.directory() / command_name).string(), results.string()));
    }
}

fs::path scene_for_restart(const fs::path& results) { return checkpoints_of(results) / scene_name; }

}  // namespace abut::apps
