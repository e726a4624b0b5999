#include "abut/ranks/session.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
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

bool is_launched() {
    constexpr std::array names{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
    for (const char* name : names)
        if (std::getenv(name) != nullptr) return true;
    return false;
}

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

void start_on(int n_ranks) {
    std::vector<std::string> words = command_for(n_ranks);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    execvp(pointers.front(), pointers.data());
    throw BadInput(std::string("ranks: mpirun cannot be started: ") + std::strerror(errno) +
                   ". Install openmpi-bin, or start the program with the mpirun that you have.");
}

}  // namespace abut::ranks
