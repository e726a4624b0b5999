#pragma once
// Private to the layer; not installed.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace abut::mesh {

/// The bytes of a file (base/input_file.hpp). Throws MeshError if it is missing, no regular file, unreadable or empty.
[[nodiscard]] std::string file_contents(const std::filesystem::path& path);

/// Makes the folder and its parents. Throws MeshError if that fails.
void make_directory(const std::filesystem::path& directory);

/// A file that is prepared under another name (hidden, in the same folder, with the same extension) and then moved into its
/// place, whole or not at all. What has not been moved is removed in the end, so that a failure leaves nothing behind.
class PreparedFile {
public:
    explicit PreparedFile(std::filesystem::path path);
    ~PreparedFile();
    PreparedFile(PreparedFile&& other) noexcept
        : path_(std::exchange(other.path_, {})), temporary_(std::exchange(other.temporary_, {})) {}
    PreparedFile& operator=(PreparedFile&&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Path to write to.
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
    /// Throws MeshError naming the path and the reason.
    void move_into_place();

private:
    std::filesystem::path path_, temporary_;
};

/// A file of these bytes, one part behind the other. Throws MeshError naming the path and the reason if they cannot be
/// written.
[[nodiscard]] PreparedFile prepared_file(const std::filesystem::path& path, std::span<const std::string_view> parts);
[[nodiscard]] PreparedFile prepared_text(const std::filesystem::path& path, std::string_view text);

}  // namespace abut::mesh
