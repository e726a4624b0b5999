#include "apps/support/signals.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <ctime>

namespace abut::apps {
namespace {

constexpr std::array<int, StopSignals::n_signals> stop_signals = {SIGINT, SIGTERM, SIGHUP};

/// timeout(1) and launchers send a signal to a process and to its group: this soon after the first it is the same [ns].
constexpr std::int64_t time_of_same = 500'000'000;

std::atomic<int> noted{0};
std::atomic<std::int64_t> noted_at{0};  // [ns]
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a handler may touch nothing that waits");

void set_action(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;  // whoever writes or waits for a process meanwhile notices nothing
    sigemptyset(&action.sa_mask);
    for (const int other : stop_signals) sigaddset(&action.sa_mask, other);  // one at a time
    sigaction(signal, &action, nullptr);
}

std::int64_t now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

/// Calls only what a handler may call.
void note(int signal) {
    if (noted.load() == 0) {
        noted_at.store(now());
        noted.store(signal);
    } else if (now() - noted_at.load() >= time_of_same) {
        set_action(signal, SIG_DFL);
        raise(signal);  // once this handler has returned
    }
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
