#include "abut/mesh/file.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "abut/mesh/quality.hpp"

namespace abut::mesh {

std::string file_contents(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw MeshError(path.string() + ": there is no such file. Check the path.");
    if (std::filesystem::is_directory(status)) throw MeshError(path.string() + ": is a folder, a mesh file is needed. Check the path.");
    std::ifstream file(path, std::ios::binary);
    std::string contents{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw MeshError(path.string() + ": cannot be read. Check its permissions.");
    if (contents.empty()) throw MeshError(path.string() + ": the file is empty (0 bytes). Write the mesh again.");
    return contents;
}

void make_directory(const std::filesystem::path& directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (!std::filesystem::is_directory(directory))
        throw MeshError(directory.string() + ": the folder cannot be made: " + (error ? error.message() : "a file is in its place") +
                        ". Choose another one or change its permissions.");
}

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
    return path.parent_path() / (std::string(".") + path.stem().string() + ".part" + path.extension().string());
}

void move_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::rename(temporary, path, error);
    if (error) throw MeshError(path.string() + ": cannot be written: " + error.message() + ". Check permissions and free space of its folder.");
}

void write_file_atomically(const std::filesystem::path& path, const std::string& text) {
    const auto temporary = temporary_beside(path);
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw MeshError(path.string() + ": cannot be written. Check permissions and free space of its folder.");
    move_into_place(temporary, path);
}

}  // namespace abut::mesh
