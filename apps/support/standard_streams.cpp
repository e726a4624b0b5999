#include "apps/support/standard_streams.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <string_view>

namespace abut::apps {
namespace {

constexpr std::string_view word =
    "note: nobody reads what the program says any more; it goes on, and its results are in its files.\n";

bool has_lost_its_reader(int stream) {
    pollfd look{.fd = stream, .events = POLLOUT, .revents = 0};
    return poll(&look, 1, 0) == 1 && (look.revents & POLLERR) != 0;
}

void lead_nowhere(int stream) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere < 0) return;
    dup2(nowhere, stream);
    close(nowhere);
}

/// Calls only what a handler may call.
void let_go(int) {
    const int error = errno;
    if (has_lost_its_reader(STDERR_FILENO)) lead_nowhere(STDERR_FILENO);
    if (has_lost_its_reader(STDOUT_FILENO)) {
        lead_nowhere(STDOUT_FILENO);
        static_cast<void>(!write(STDERR_FILENO, word.data(), word.size()));
    }
    errno = error;
}

}  // namespace

void open_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})  // each file takes the lowest number that is free
        if (fcntl(stream, F_GETFD) < 0 && errno == EBADF)
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_RDONLY : O_WRONLY) < 0);
}

void go_on_at_largest_file() { static_cast<void>(std::signal(SIGXFSZ, SIG_IGN)); }

void say(const std::string& text) { std::fputs(text.c_str(), stdout); }

GoOnWithoutReader::GoOnWithoutReader() {
    sigaction(SIGPIPE, nullptr, &before_);
    if (before_.sa_handler == SIG_IGN) return;
    Action action{};
    action.sa_handler = let_go;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(SIGPIPE, &action, nullptr);
}

GoOnWithoutReader::~GoOnWithoutReader() {
    std::fflush(stdout);  // what is left of it may find no reader either
    sigaction(SIGPIPE, &before_, nullptr);
}

}  // namespace abut::apps
