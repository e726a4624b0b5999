#pragma once
#include <filesystem>
#include <string>

namespace abut::mesh {

/// The bytes of a file. Throws MeshError if it is missing, a folder, unreadable or empty.
[[nodiscard]] std::string file_contents(const std::filesystem::path& path);

/// Makes the folder and its parents. Throws MeshError if that fails.
void make_directory(const std::filesystem::path& directory);

/// Puts `text` into the file whole or not at all: it is written beside it, then moved there. Throws MeshError.
void write_file_atomically(const std::filesystem::path& path, const std::string& text);

/// Where a file is prepared before `move_into_place`: hidden, in the same folder, with the same extension.
[[nodiscard]] std::filesystem::path temporary_beside(const std::filesystem::path& path);
void move_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path);

}  // namespace abut::mesh
