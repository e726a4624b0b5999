#pragma once
#include <array>
#include <csignal>
#include <cstddef>

#include "abut/run/observer.hpp"

namespace abut::apps {

/// While it lives, the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone) is noted, so that a run can end
/// well; one that comes half a second later or more ends the process at once. A signal that whoever started the program
/// ignores stays ignored. Afterwards all is as it was before.
class StopSignals {
public:
    static constexpr std::size_t n_signals = 3;

    StopSignals();
    ~StopSignals();
    StopSignals(const StopSignals&) = delete;
    StopSignals& operator=(const StopSignals&) = delete;

private:
    using Action = struct sigaction;

    std::array<Action, n_signals> before_{};
};

/// The signal that was noted; 0: none. It stays so until the process ends.
[[nodiscard]] int noted_signal();

/// Exit code of a process that ends because of the signal, as a shell calls it: 130 for SIGINT, 143 for SIGTERM, 129 for
/// SIGHUP.
[[nodiscard]] constexpr int exit_code_of(int signal) { return 128 + signal; }

/// "SIGINT", "SIGTERM" or "SIGHUP"
[[nodiscard]] const char* name_of_signal(int signal);

/// Asks a run to stop once a signal was noted.
template <int Dim>
class StopOnSignal : public run::Observer<Dim> {
public:
    [[nodiscard]] bool asks_to_stop() const override { return noted_signal() != 0; }
    [[nodiscard]] bool wants_look(std::int64_t) const override { return false; }
};

}  // namespace abut::apps
