#pragma once
// Private to the layer.
#include <filesystem>
#include <vector>

#include "abut/input/fault.hpp"
#include "abut/input/scene_file.hpp"
#include "abut/input/settings.hpp"

namespace abut::input {

/// A scene as its file and `overrides` have it, and what of it could not be taken: that keeps its default.
struct ReadSettings {
    Settings settings;
    std::vector<Fault> faults;
};

/// Throws SceneError where there is no TOML to read.
[[nodiscard]] ReadSettings read_settings(const std::filesystem::path& path, const Overrides& overrides);
[[nodiscard]] ReadSettings read_settings(const SceneText& scene, const Overrides& overrides);

}  // namespace abut::input
