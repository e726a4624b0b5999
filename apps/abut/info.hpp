#pragma once
#include <filesystem>
#include <string>

namespace abut::apps {

/// Content of a mesh (.msh, .vtu), a surface (.stl, .obj, .off, .ply, .vtp, .msh, .vtu), a scene (.toml) or a folder of
/// results, a line for each figure with its unit. Throws BadInput for what cannot be read, with what can be.
[[nodiscard]] std::string info(const std::filesystem::path& path);

}  // namespace abut::apps
