#include "programs/child.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

#include "programs/program.hpp"

namespace abut::test::programs {
namespace {

constexpr std::chrono::minutes patience{2};
constexpr std::chrono::milliseconds between_looks{2};

}  // namespace

Child::Child(const std::string& program, std::vector<std::string> arguments, const std::filesystem::path& out) {
    const std::string path = std::string(ABUT_PROGRAM_FOLDER) + "/" + program;
    arguments.insert(arguments.begin(), path);
    std::vector<char*> words;
    for (std::string& word : arguments) words.push_back(word.data());
    words.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;  // signals mean what they mean by default, whoever runs the test
    posix_spawnattr_init(&attributes);
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&attributes, &all);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    const int error = posix_spawn(&id_, path.c_str(), &actions, &attributes, words.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error(path + " cannot be started");
}

Child::~Child() {
    if (ended_) return;
    send(SIGKILL);
    static_cast<void>(wait());
}

void Child::send(int signal) const { kill(id_, signal); }

void Child::wait_until(const std::function<bool()>& reached) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!reached()) {
        if (has_ended(WNOHANG)) throw std::runtime_error("the program has ended too early");
        if (std::chrono::steady_clock::now() > end) throw std::runtime_error("the program takes too long");
        std::this_thread::sleep_for(between_looks);
    }
}

int Child::wait() {
    while (!has_ended(0)) continue;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
}

bool Child::has_ended(int options) {
    if (!ended_) ended_ = waitpid(id_, &status_, options) == id_;
    return ended_;
}

std::size_t lines_in(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(file), {}, '\n'));
}

std::vector<std::string> long_run(const std::filesystem::path& out) {
    return {"run",        std::string(ABUT_SCENES) + "/slipping_cylinders.toml",
            "--set",      "values.size=0.3",
            "--steps",    "100000000",
            "--interval", "7",
            "--frames",   "3",
            "--threads",  "1",
            "--out",      out.string()};
}

bool any_partial(const std::filesystem::path& directory) {
    return std::ranges::any_of(files_in(directory), [](const std::string& name) {
        return name.find(".part") != std::string::npos || name == ".abut.lock";
    });
}

}  // namespace abut::test::programs
