#include "abut/ranks/session.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

#include "abut/ranks/mpi.hpp"

namespace abut::ranks {
namespace {

/// Arguments of this process, its own name first.
std::vector<std::string> arguments() {
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(file), {}};
    std::vector<std::string> words;
    for (std::size_t at = 0; at < all.size();) {
        words.emplace_back(all.c_str() + at);
        at += words.back().size() + 1;
    }
    return words;
}

}  // namespace

Session::Session() {
    int provided = 0;
    require(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided), "MPI_Init_thread");
    all_ = std::make_unique<Communicator>(MPI_Comm_c2f(MPI_COMM_WORLD));
    farewell_ = std::make_unique<Communicator>(MPI_Comm_c2f(MPI_COMM_WORLD));
    MPI_Comm here = MPI_COMM_NULL;
    require(MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here), "MPI_Comm_split_type");
    MPI_Comm_size(here, &here_);
    MPI_Comm_free(&here);
}

Session::~Session() {
    farewell_.reset();
    all_.reset();
    MPI_Finalize();
}

void Session::leave_with_error(std::chrono::milliseconds patience, const std::function<void()>& last_words) const {
    MPI_Request all_here = MPI_REQUEST_NULL;
    MPI_Ibarrier(handle(*farewell_), &all_here);
    const auto give_up = std::chrono::steady_clock::now() + patience;
    for (int done = 0; done == 0; std::this_thread::sleep_for(std::chrono::milliseconds(10))) {
        MPI_Test(&all_here, &done, MPI_STATUS_IGNORE);
        if (done == 0 && std::chrono::steady_clock::now() > give_up) {
            last_words();
            MPI_Abort(handle(*farewell_), 1);
        }
    }
}

std::vector<std::string> command_for(int n_ranks) {
    std::vector<std::string> command{"mpirun", "--oversubscribe", "--bind-to", "none"};
    if (geteuid() == 0) command.emplace_back("--allow-run-as-root");
    command.insert(command.end(), {"-n", std::to_string(n_ranks), std::filesystem::read_symlink("/proc/self/exe").string()});
    const std::vector<std::string> words = arguments();
    for (std::size_t i = 1; i < words.size(); ++i) command.push_back(words[i]);
    return command;
}

int most_ranks_here() {
    constexpr int per_processor = 16, least = 64;
    return std::max(least, per_processor * static_cast<int>(std::thread::hardware_concurrency()));
}

namespace {

constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<pid_t> process_of_mpirun{0};
std::atomic<int> noted{0};

/// What a terminal sends, it sends to mpirun as well; the rest is passed on. Calls only what a handler may call.
void pass_on(int signal, siginfo_t* info, void*) {
    noted.store(signal);
    if (info->si_code <= 0) kill(process_of_mpirun.load(), signal);
}

void set_action(int signal, bool passes_on) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) return;
    action = {};
    action.sa_flags = passes_on ? SA_SIGINFO | SA_RESTART : 0;
    if (passes_on)
        action.sa_sigaction = pass_on;
    else
        action.sa_handler = SIG_DFL;
    sigaction(signal, &action, nullptr);
}

[[noreturn]] void refuse_start(int error) {
    throw BadInput(std::string("ranks: mpirun cannot be started: ") + std::strerror(error) +
                   ". Install openmpi-bin, or start the program with the mpirun that you have.");
}

/// Its process; it ends with this one, however that ends. `told` is where it says why it cannot begin.
pid_t start_command(const std::vector<char*>& words, const sigset_t& blocked, int told) {
    [[maybe_unused]] const pid_t parent = getpid();
    const pid_t child = fork();
    if (child != 0) return child;
    pthread_sigmask(SIG_SETMASK, &blocked, nullptr);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(1);
#endif
    execvp(words.front(), words.data());
    const int error = errno;
    static_cast<void>(!write(told, &error, sizeof(error)));
    _exit(1);
}

/// A folder for what Open MPI notes of a run while it lasts, unless somebody has named one. Without it all runs of a user
/// on a machine share one, and of two that begin together one may end with "File exists".
class OwnNotes {
public:
    OwnNotes() {
        constexpr const char* place = "OMPI_MCA_orte_tmpdir_base";
        std::error_code none;
        std::string folder = (std::filesystem::temp_directory_path(none) / "abut_mpi_XXXXXX").string();
        if (std::getenv(place) || none || !mkdtemp(folder.data())) return;
        folder_ = folder;
        setenv(place, folder.c_str(), 1);
    }
    void remove() const {
        std::error_code stays;
        if (!folder_.empty()) std::filesystem::remove_all(folder_, stays);
    }

private:
    std::filesystem::path folder_;
};

int code_of(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR) return 1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

void start_on(int n_ranks) {
    if (isatty(STDOUT_FILENO) != 1) setenv(plain_output, "1", 1);
    const OwnNotes notes;
    std::vector<std::string> words = command_for(n_ranks);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::array<int, 2> told{};
    if (pipe2(told.data(), O_CLOEXEC) != 0) refuse_start(errno);
    sigset_t ending, before;
    sigemptyset(&ending);
    for (const int signal : ending_signals) sigaddset(&ending, signal);
    pthread_sigmask(SIG_BLOCK, &ending, &before);
    const pid_t mpirun = start_command(pointers, before, told[1]);
    const int error = errno;
    close(told[1]);
    process_of_mpirun = mpirun;
    if (mpirun > 0)
        for (const int signal : ending_signals) set_action(signal, true);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (mpirun < 0) refuse_start(error);
    int reason = 0;
    const bool has_begun = read(told[0], &reason, sizeof(reason)) == 0;  // its end is closed where the command has begun
    close(told[0]);
    const int code = code_of(mpirun);
    notes.remove();
    for (const int signal : ending_signals) set_action(signal, false);
    if (!has_begun) refuse_start(reason);
    std::exit(noted != 0 ? 128 + noted : code);
}

}  // namespace abut::ranks
