#include "apps/support/progress.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "apps/support/standard_streams.hpp"
#include "apps/support/terminal.hpp"

#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"

namespace abut::apps {
namespace {

constexpr std::chrono::milliseconds between_updates{100};
constexpr std::chrono::milliseconds between_log_lines{2000};  // where nobody knows what a tenth is

/// The first step after `step` that ends a tenth of all.
std::int64_t next_tenth(std::int64_t step, std::int64_t n_steps) {
    const std::int64_t tenths = step * 10 / n_steps + 1;
    return (tenths * n_steps + 9) / 10;
}

}  // namespace

Progress::Progress(std::int64_t n_steps)
    : n_steps_(n_steps),
      time_left_(n_steps),
      terminal_(is_terminal(STDOUT_FILENO)),
      next_step_(next_tenth(0, n_steps)),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
    if (!line_open_) return;
    std::fputs("\n", stdout);
    std::fflush(stdout);
}

void Progress::show(std::int64_t step, double time, double drift) {
    const auto now = Clock::now();
    time_left_.add(step, std::chrono::duration<double>(now - start_).count());
    const bool due = terminal_ ? step == n_steps_ || now - last_ >= between_updates : step >= next_step_;
    if (!due) return;
    const std::string line =
        fmt::format("step {:>{}}/{}  t = {:.4g} s  energy drift {:.1e}  {} left", step, std::to_string(n_steps_).size(),
                    n_steps_, time, drift, duration(time_left_.seconds()));
    last_ = now;
    next_step_ = next_tenth(step, n_steps_);
    line_open_ = terminal_;
    if (!terminal_) return spdlog::info("{}", line);
    say(fmt::format("\r{}\033[K", line));
    std::fflush(stdout);
}

SettlingLine::SettlingLine() : terminal_(is_terminal(STDOUT_FILENO)) {}

SettlingLine::~SettlingLine() {
    if (!line_open_) return;
    std::fputs("\n", stdout);
    std::fflush(stdout);
}

void SettlingLine::show(std::int64_t step, double speed) {
    const auto now = Clock::now();
    if (now - last_ < (terminal_ ? between_updates : between_log_lines)) return;
    last_ = now;
    const std::string line = fmt::format("coming to rest: step {}  largest speed {:.2e} m/s", step, speed);
    if (!terminal_) return spdlog::info("{}", line);
    line_open_ = true;
    say(fmt::format("\r{}\033[K", line));
    std::fflush(stdout);
}

template <int Dim>
void ShowProgress<Dim>::settling(std::int64_t step, double speed) {
    if (!settling_) settling_.emplace();
    settling_->show(step, speed);
}

template <int Dim>
void ShowProgress<Dim>::begin(const run::Scene<Dim>&, const run::RunResult<Dim>& result) {
    settling_.reset();
    progress_.emplace(result.run.steps);
}

template <int Dim>
void ShowProgress<Dim>::record(const dynamics::LedgerEntry<Dim>&, const run::RunResult<Dim>& result) {
    drift_ = result.energy.scale.over(result.ledger.pseudo_energy_drift());
}

template <int Dim>
void ShowProgress<Dim>::progress(std::int64_t step, double time) {
    if (step > 0) progress_->show(step, time, drift_);
}

template class ShowProgress<2>;
template class ShowProgress<3>;

}  // namespace abut::apps
