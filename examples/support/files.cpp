#include "support/files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace abut::examples {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_directory(const fs::path& directory, const std::string& reason) {
    throw std::runtime_error(fmt::format("--out {}: the folder cannot be written to: {}. Choose another folder or change its permissions.",
                                         directory.string(), reason));
}

}  // namespace

void prepare_directory(const fs::path& directory) {
    std::error_code error;
    fs::create_directories(directory, error);
    if (!fs::is_directory(directory)) refuse_directory(directory, error ? error.message() : "a file is in its place");
    const fs::path probe = directory / ".writable";
    std::ofstream file(probe);
    file << "abut\n";
    file.close();
    if (!file) refuse_directory(directory, "permission denied or no space left");
    fs::remove(probe, error);
}

void write_whole(const fs::path& path, const std::string& text) {
    fs::path partial = path;
    partial += ".partial";
    std::ofstream file(partial, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be written. Check permissions and free space of its folder.", partial.string()));
    move_file(partial, path);
}

void move_file(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error) throw std::runtime_error(fmt::format("{}: cannot be written: {}. Check permissions of its folder.", to.string(), error.message()));
}

}  // namespace abut::examples
