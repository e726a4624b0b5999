#include "abut/run/files/partial_file.hpp"

#include <string>
#include <system_error>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/files/files.hpp"

namespace abut::run {

PartialFile::PartialFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) { partial_ += ".partial"; }

void PartialFile::open() {
    file_.open(partial_, std::ios::binary);
    check();
}

void PartialFile::go_on_after(std::uintmax_t size) {
    std::error_code error;
    if (!std::filesystem::exists(partial_)) std::filesystem::rename(path_, partial_, error);
    const std::uintmax_t found = error ? 0 : std::filesystem::file_size(partial_, error);
    if (error || found < size)
        throw BadInput(partial_.string() + ": " + std::to_string(error ? 0 : found) + " bytes are there, " +
                       std::to_string(size) +
                       " were when the checkpoint was made. Put the file back, or run from the start.");
    std::filesystem::resize_file(partial_, size, error);
    if (error) throw BadInput(cannot_be_written(partial_, error.message()));
    file_.open(partial_, std::ios::binary | std::ios::app);
    check();
}

std::uintmax_t PartialFile::size() {
    flush();
    return std::filesystem::file_size(partial_);
}

void PartialFile::write(std::string_view text) {
    file_ << text;
    check();
}

void PartialFile::flush() {
    file_.flush();
    check();
}

void PartialFile::finish() {
    file_.close();
    check();
    move_file(partial_, path_);
}

void PartialFile::check() const {
    if (!file_) throw BadInput(cannot_be_written(partial_));
}

}  // namespace abut::run
