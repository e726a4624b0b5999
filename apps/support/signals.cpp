#include "apps/support/signals.hpp"

#include <atomic>
#include <cstddef>

namespace abut::apps {
namespace {

constexpr std::array<int, StopSignals::n_signals> stop_signals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> noted{0};
static_assert(std::atomic<int>::is_always_lock_free, "a handler may touch nothing that waits");

void set_action(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;  // whoever writes or waits for a process meanwhile notices nothing
    sigemptyset(&action.sa_mask);
    for (const int other : stop_signals) sigaddset(&action.sa_mask, other);  // one at a time
    sigaction(signal, &action, nullptr);
}

/// Calls only what a handler may call.
void note(int signal) {
    noted.store(signal);
    for (const int other : stop_signals) set_action(other, SIG_DFL);
}

}  // namespace

StopSignals::StopSignals() {
    for (std::size_t i = 0; i < stop_signals.size(); ++i) {
        sigaction(stop_signals[i], nullptr, &before_[i]);
        if (before_[i].sa_handler != SIG_IGN) set_action(stop_signals[i], note);
    }
}

StopSignals::~StopSignals() {
    for (std::size_t i = 0; i < stop_signals.size(); ++i) sigaction(stop_signals[i], &before_[i], nullptr);
}

int noted_signal() { return noted.load(); }

const char* name_of_signal(int signal) { return signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM"; }

}  // namespace abut::apps
