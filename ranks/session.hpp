#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "abut/ranks/communicator.hpp"

namespace abut::ranks {

/// Whether mpirun, or what stands for it, has started this process as one of several: as its environment says (Open MPI,
/// MPICH and others that follow PMI, Slurm's srun).
[[nodiscard]] bool is_launched();
/// Variable of the environment of ranks whose launcher (`start_on`) writes to no terminal: mpirun gives them one of its own.
inline constexpr const char* plain_output = "ABUT_PLAIN_OUTPUT";

/// MPI from here to the end of the scope, for programs of ours; a host has its own, and needs none of this. One in a
/// process.
class Session {
public:
    Session();
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    [[nodiscard]] const Communicator& all() const { return *all_; }
    [[nodiscard]] int ranks_on_this_machine() const { return here_; }
    /// To be called by a rank that ends with an error: where the others do not come as well within `patience`, they wait for
    /// it in vain. Then it calls `last_words`, and all are ended.
    void leave_with_error(std::chrono::milliseconds patience, const std::function<void()>& last_words) const;

private:
    std::unique_ptr<Communicator> all_;
    std::unique_ptr<Communicator> farewell_;  // of `leave_with_error` alone
    int here_ = 1;
};

/// The command that starts this program on so many ranks of this machine, with the arguments that it was given.
[[nodiscard]] std::vector<std::string> command_for(int n_ranks);

/// How many ranks start_on may be asked for on this machine: 16 per processor, 64 at least.
[[nodiscard]] int most_ranks_here();

/// Runs that command in place of this process: does not return. The process ends with its exit code, or with 130, 143 or 129
/// where SIGINT, SIGTERM or SIGHUP has ended it; the command is sent these, and ends where this process ends. To be
/// called before the program has threads. Throws BadInput where the command cannot be started.
[[noreturn]] void start_on(int n_ranks);

}  // namespace abut::ranks
