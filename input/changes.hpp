#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace abut::input {

/// Differences between two scenes, a sentence without its full stop for each key, in the order of the first file and then of
/// the second: "bodies.left.density is the number 2 now, it was the number 1". Keys that differ in order alone are no
/// difference, nor are comments. Throws SceneError where one of the files is not there or is no TOML.
[[nodiscard]] std::vector<std::string> changed_keys(const std::filesystem::path& before, const std::filesystem::path& now);

}  // namespace abut::input
