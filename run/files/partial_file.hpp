#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

namespace abut::run {

/// A file of text that is written as a run goes: it is called `path`.partial until `finish`, which gives it its name. Each
/// function throws BadInput naming the file if it cannot be written.
class PartialFile {
public:
    explicit PartialFile(std::filesystem::path path);

    void open();  ///< empty, whatever was there before
    /// Goes on behind the first `size` bytes of it; what follows them is gone. A file that had got its name is taken back.
    /// Throws BadInput if it is not there, or shorter.
    void go_on_after(std::uintmax_t size);
    void write(std::string_view text);
    void flush();  ///< what is written by now outlives the process
    void finish();

    /// Size of what is written by now [bytes]; it outlives the process.
    [[nodiscard]] std::uintmax_t size();
    [[nodiscard]] bool is_open() const { return file_.is_open(); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    void check() const;

    std::filesystem::path path_;
    std::filesystem::path partial_;
    std::ofstream file_;
};

}  // namespace abut::run
