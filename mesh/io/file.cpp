#include "abut/mesh/io/file.hpp"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "abut/base/error.hpp"
#include "abut/base/input_file.hpp"
#include "abut/mesh/quality.hpp"

namespace abut::mesh {

std::string file_contents(const std::filesystem::path& path) {
    std::string contents;
    try {
        contents = file_bytes(path);
    } catch (const BadInput& error) {
        throw MeshError(error.what());
    }
    if (contents.empty()) throw MeshError(path.string() + ": the file is empty (0 bytes). Write the mesh again.");
    return contents;
}

void make_directory(const std::filesystem::path& directory) {
    std::error_code error, unknown;
    std::filesystem::create_directories(directory, error);
    const auto status = std::filesystem::status(directory, unknown);
    if (!std::filesystem::is_directory(status))
        throw MeshError(directory.string() + ": the folder cannot be made: " +
                        (std::filesystem::exists(status) ? "a file is in its place" : (error ? error : unknown).message()) +
                        ". Choose another one or change its permissions.");
}

PreparedFile::PreparedFile(std::filesystem::path path)
    : path_(std::move(path)),
      temporary_(path_.parent_path() / ("." + path_.stem().string() + ".part" + path_.extension().string())) {}

PreparedFile::~PreparedFile() {
    std::error_code ignored;
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void PreparedFile::move_into_place() {
    std::error_code error;
    std::filesystem::rename(temporary_, path_, error);
    if (error)
        throw MeshError(path_.string() + ": cannot be written: " + error.message() +
                        ". Check permissions and free space of its folder, and the limit of file sizes (ulimit -f).");
    temporary_.clear();
}

PreparedFile prepared_file(const std::filesystem::path& path, std::span<const std::string_view> parts) {
    PreparedFile prepared(path);
    errno = 0;
    std::ofstream file(prepared.temporary(), std::ios::binary);
    for (const std::string_view part : parts) file.write(part.data(), static_cast<std::streamsize>(part.size()));
    file.close();
    if (!file) {
        const std::string reason = errno != 0 ? std::generic_category().message(errno) : "the folder takes no more";
        throw MeshError(path.string() + ": cannot be written: " + reason +
                        ". Check permissions and free space of its folder, and the limit of file sizes (ulimit -f).");
    }
    return prepared;
}

PreparedFile prepared_text(const std::filesystem::path& path, std::string_view text) {
    return prepared_file(path, {&text, 1});
}

}  // namespace abut::mesh
