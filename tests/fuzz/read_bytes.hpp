#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace abut::fuzz {

/// A file name of its own in a folder of its own, gone at the end; not after a crash, where it is the evidence.
class ScratchFile {
public:
    explicit ScratchFile(const std::string& extension);
    ~ScratchFile();
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

struct Outcome {
    bool is_fault;
    std::string text;  ///< "read", what the error says, or the fault
};

/// Reads a surface. A file may be read or refused with an abut::Error that names it; anything else is a fault, and so are
/// more memory than `memory_limit` and an error that memory ran out.
[[nodiscard]] Outcome read_file(const std::filesystem::path& path);

/// The same, of these bytes; they stay in `path`.
[[nodiscard]] Outcome read_bytes(std::string_view bytes, const std::filesystem::path& path);

inline constexpr long memory_limit = 200;  ///< [MB] that one read may add to the most memory of the process

}  // namespace abut::fuzz
