#include "abut/run/files/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <system_error>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/run/files/files.hpp"

namespace abut::run {
namespace {

namespace fs = std::filesystem;

constexpr int most_attempts = 1000;
constexpr mode_t read_and_write = 0666;  // for all whom the user's mask does not forbid it

std::string reason_of(int error) { return std::generic_category().message(error); }

/// A file that is open until the end of its scope, or handed on.
class OpenFile {
public:
    explicit OpenFile(int number) : number_(number) {}
    ~OpenFile() {
        if (number_ >= 0) close(number_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] int hand_on() { return std::exchange(number_, -1); }

private:
    int number_;
};

void make_directory(const fs::path& directory) {
    std::error_code error, unknown;
    fs::create_directories(directory, error);
    const auto status = fs::status(directory, unknown);
    if (!fs::is_directory(status))
        refuse_directory(directory, fs::exists(status) ? "a file is in its place" : (error ? error : unknown).message());
    if (access(directory.c_str(), W_OK | X_OK) != 0) refuse_directory(directory, reason_of(errno));
}

int open_lock(const fs::path& directory, const fs::path& path) {
    const int file = open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, read_and_write);
    if (file < 0)
        refuse_directory(directory, errno == ELOOP ? fmt::format("a link is in the place of {}", path.filename().string())
                                                   : reason_of(errno));
    return file;
}

/// One line: "slipping_cylinders, process 4711, since 2026-01-31 12:00:00 UTC".
std::string owner_of_this_run(const std::string& program) {
    return fmt::format("{}, process {}, since {:%Y-%m-%d %H:%M:%S} UTC", program, getpid(), fmt::gmtime(std::time(nullptr)));
}

std::string owner_in(int file) {
    std::array<char, 200> text{};
    const ssize_t length = pread(file, text.data(), text.size(), 0);
    const std::string owner(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    return owner.substr(0, owner.find('\n'));
}

[[noreturn]] void refuse_taken(const fs::path& directory, const std::string& owner) {
    throw BadInput(
        fmt::format("--out {}: another run writes to this folder: {}. Choose another folder with --out, or wait until that "
                    "run has ended.",
                    directory.string(), owner.empty() ? "it has not said yet which" : owner));
}

void take(int file, const fs::path& directory) {
    if (flock(file, LOCK_EX | LOCK_NB) == 0) return;
    if (errno == EWOULDBLOCK) refuse_taken(directory, owner_in(file));
    const bool no_locks = errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP;
    if (!no_locks) refuse_directory(directory, reason_of(errno));
}

/// True if the open file still is what its name leads to.
bool is_in_place(int file, const fs::path& path) {
    struct stat opened {};
    struct stat named {};
    return fstat(file, &opened) == 0 && lstat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
           opened.st_dev == named.st_dev;
}

/// Nothing that has another name, too, is written to.
void check_plain(int file, const fs::path& directory, const fs::path& path) {
    struct stat opened {};
    if (fstat(file, &opened) != 0) refuse_directory(directory, reason_of(errno));
    if (!S_ISREG(opened.st_mode) || opened.st_nlink > 1)
        refuse_directory(directory, fmt::format("{} is no file of its own", path.filename().string()));
}

/// Also the proof that the folder can be written to.
void write_owner(int file, const fs::path& directory, const std::string& owner) {
    const std::string line = owner + "\n";
    errno = 0;
    if (ftruncate(file, 0) == 0 && pwrite(file, line.data(), line.size(), 0) == static_cast<ssize_t>(line.size())) return;
    refuse_directory(directory, errno == 0 ? "no space left" : reason_of(errno));
}

}  // namespace

FolderLock::FolderLock(const fs::path& directory, const std::string& program) {
    make_directory(directory);
    path_ = fs::absolute(directory) / ".abut.lock";
    for (int attempt = 0; file_ < 0; ++attempt) {
        if (attempt == most_attempts) refuse_directory(directory, "its lock is removed again and again");
        OpenFile file(open_lock(directory, path_));
        check_plain(file.number(), directory, path_);
        take(file.number(), directory);
        if (is_in_place(file.number(), path_)) file_ = file.hand_on();
    }
    try {
        write_owner(file_, directory, owner_of_this_run(program));
    } catch (...) {
        release();
        throw;
    }
}

FolderLock::~FolderLock() { release(); }

FolderLock::FolderLock(FolderLock&& other) noexcept : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

FolderLock& FolderLock::operator=(FolderLock&& other) noexcept {
    if (this == &other) return *this;
    release();
    path_ = std::move(other.path_);
    file_ = std::exchange(other.file_, -1);
    return *this;
}

void FolderLock::release() noexcept {
    if (file_ < 0) return;
    if (is_in_place(file_, path_)) unlink(path_.c_str());
    close(std::exchange(file_, -1));
}

}  // namespace abut::run
