#pragma once
#include <chrono>
#include <cstdint>
#include <optional>

#include "abut/run/observer.hpp"
#include "apps/support/time_left.hpp"

namespace abut::apps {

/// How far a run has come: one line that rewrites itself on a terminal, otherwise a line of the log every tenth of the way.
class Progress {
public:
    explicit Progress(std::int64_t n_steps);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `drift` is |H~ - H~0| over the energy scale of the run as last measured [-].
    void show(std::int64_t step, double time, double drift);

private:
    using Clock = std::chrono::steady_clock;

    std::int64_t n_steps_;
    TimeLeft time_left_;
    bool terminal_;
    bool line_open_ = false;
    std::int64_t next_step_;
    Clock::time_point start_;
    Clock::time_point last_;
};

/// How far bodies have come to rest before a run, whose number of steps nobody knows: one line that rewrites itself on
/// a terminal, otherwise a line of the log now and then.
class SettlingLine {
public:
    SettlingLine();
    ~SettlingLine();
    SettlingLine(const SettlingLine&) = delete;
    SettlingLine& operator=(const SettlingLine&) = delete;

    void show(std::int64_t step, double speed);

private:
    using Clock = std::chrono::steady_clock;

    bool terminal_;
    bool line_open_ = false;
    Clock::time_point last_ = Clock::now();
};

/// Shows the progress of a run.
template <int Dim>
class ShowProgress : public run::Observer<Dim> {
public:
    void settling(std::int64_t step, double speed) override;
    void begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) override;
    void record(const dynamics::LedgerEntry<Dim>& entry, const run::RunResult<Dim>& result) override;
    void progress(std::int64_t step, double time) override;
    [[nodiscard]] bool wants_look(std::int64_t) const override { return false; }

private:
    std::optional<SettlingLine> settling_;
    std::optional<Progress> progress_;
    double drift_ = 0.0;  // of H~ so far, over the energy scale
};

}  // namespace abut::apps
