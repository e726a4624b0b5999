#include "abut/run/partial_file.hpp"

#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/files.hpp"

namespace abut::run {

PartialFile::PartialFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) { partial_ += ".partial"; }

void PartialFile::open() {
    file_.open(partial_, std::ios::binary);
    check();
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
