#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace abut::apps {

/// What `abut run` leaves beside its checkpoints, for `abut restart`: the scene, where it was, and the command line.
struct Restart {
    std::filesystem::path scene;         ///< that was run, with its whole path
    std::vector<std::string> arguments;  ///< of the command line, the name of the program first
};

/// Names and texts of the files beside the checkpoints. Throws BadInput if the scene cannot be read.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> files_for_restart(const Restart& restart);
/// From the folder of results of a run; throws BadInput for one that has no such files.
[[nodiscard]] Restart read_restart(const std::filesystem::path& results);
/// The copy of the scene there.
[[nodiscard]] std::filesystem::path scene_for_restart(const std::filesystem::path& results);

}  // namespace abut::apps
