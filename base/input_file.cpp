#include "abut/base/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <system_error>

#include "abut/base/error.hpp"

namespace abut {
namespace {

/// Closed at the end.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) close(number);
    }
};

const char* kind_of(mode_t mode) {
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a pipe";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
    throw BadInput(path.string() + ": " + what);
}

[[noreturn]] void refuse_because(const std::filesystem::path& path, int error) {
    if (error == ENOENT) refuse(path, "there is no such file. Check the path.");
    refuse(path, "cannot be read: " + std::generic_category().message(error) + ". Check the path and its permissions.");
}

}  // namespace

std::string file_bytes(const std::filesystem::path& path) {
    // Without O_NONBLOCK a pipe that nobody writes to would be waited for here.
    const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
    if (file.number < 0 && errno != ENXIO) refuse_because(path, errno);  // ENXIO: a socket, or a device without a driver
    struct stat status {};
    if ((file.number < 0 ? stat(path.c_str(), &status) : fstat(file.number, &status)) != 0) refuse_because(path, errno);
    if (!S_ISREG(status.st_mode))
        refuse(path, std::string("is ") + kind_of(status.st_mode) +
                         ", a file is needed. Check the path, or save what it gives into a file.");
    std::string bytes;
    std::size_t n = 0;
    while (true) {
        // One byte more than there should be: the end is then seen without another round.
        const std::size_t expected = n == 0 ? static_cast<std::size_t>(status.st_size) + 1 : n + n / 2 + 4096;
        bytes.resize(expected);
        while (n < bytes.size()) {
            const ssize_t got = read(file.number, bytes.data() + n, bytes.size() - n);
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) refuse_because(path, errno);
            if (got == 0) {
                bytes.resize(n);
                return bytes;
            }
            n += static_cast<std::size_t>(got);
        }
    }
}

}  // namespace abut
