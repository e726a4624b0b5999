#pragma once
#include <filesystem>
#include <string>

namespace abut::examples {

/// Makes the folder with its parents and proves by a file that it can be written to. Throws std::runtime_error naming the
/// folder, the reason and what to do.
void prepare_directory(const std::filesystem::path& directory);

/// Writes a file beside its place, then moves it there: it is never seen half-written. Throws std::runtime_error.
void write_whole(const std::filesystem::path& path, const std::string& text);

/// Throws std::runtime_error naming the file.
void move_file(const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace abut::examples
