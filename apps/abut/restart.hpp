#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::apps {

/// Data that `abut run` leaves beside its checkpoints, for `abut restart`: the scene, where it was, and the command line.
struct Restart {
    std::filesystem::path scene;         ///< that was run, with its whole path
    std::vector<std::string> arguments;  ///< of the command line, the name of the program first
    std::optional<double> until{};       ///< end of the run [s], where a restart has set another one
};

/// Names and texts of the files beside the checkpoints. The text of the scene
/// is that of `copy`. Throws BadInput if it cannot be read.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> files_for_restart(const Restart& restart,
                                                                                 const std::filesystem::path& copy);
/// From the folder of results of a run; throws BadInput for one that has no such files.
[[nodiscard]] Restart read_restart(const std::filesystem::path& results);
/// The copy of the scene there.
[[nodiscard]] std::filesystem::path scene_for_restart(const std::filesystem::path& results);

/// Changes of the scene since, as a sentence; empty where it is as it was, or where nothing of it is known.
[[nodiscard]] std::string changes_since(const std::filesystem::path& scene, const std::filesystem::path& results);

}  // namespace abut::apps
