#pragma once
// Private to the layer; not installed.
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "abut/mesh/io/file.hpp"

namespace abut::mesh {

/// Makes the folder of a series and that of its frames. Throws MeshError naming the one that cannot be made.
void make_folders(const std::filesystem::path& directory);
/// BASENAME_000012.vtp, with the extension given.
[[nodiscard]] std::string frame_name(const std::string& basename, std::size_t frame, const char* extension);
/// frames/BASENAME_000012.vtp
[[nodiscard]] std::filesystem::path frame_path(const std::string& basename, std::size_t frame, const char* extension);
/// BASENAME.pvd: the frames with their times [s]. Throws MeshError.
[[nodiscard]] PreparedFile prepared_list(const std::filesystem::path& directory, const std::string& basename,
                                         const char* extension, const std::vector<double>& times);
/// Throws MeshError naming the first of so many frames that is not there.
void require_frames(const std::filesystem::path& directory, const std::string& basename, const char* extension,
                    std::size_t n_frames);

}  // namespace abut::mesh
