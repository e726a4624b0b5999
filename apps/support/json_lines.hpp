#pragma once
#include <chrono>
#include <cstdint>
#include <exception>
#include <string>

#include "abut/run/observer.hpp"
#include "apps/support/time_left.hpp"

namespace abut::apps {

/// Tells a run to a machine: each line on standard output is one object of JSON, written at once, whose "event" says what it
/// is. docs/results.md has all of them; units are SI, and null is what is not known.
template <int Dim>
class JsonLines : public run::Observer<Dim> {
public:
    explicit JsonLines(std::string program);

    /// "settling", twice a second at most.
    void settling(std::int64_t step, double speed) override;
    /// "start", and a "warning" for each that is known by then, notes included.
    void begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) override;
    /// "record": an entry of the ledger, in the names of energy.csv.
    void record(const dynamics::LedgerEntry<Dim>& entry, const run::RunResult<Dim>& result) override;
    /// "progress", twice a second at most.
    void progress(std::int64_t step, double time) override;
    [[nodiscard]] bool wants_look(std::int64_t) const override { return false; }
    /// A "warning" for each that the finished run shows, and "end".
    void end(const run::RunResult<Dim>& result, int exit_code);

private:
    using Clock = std::chrono::steady_clock;

    std::string program_;
    const run::Scene<Dim>* scene_ = nullptr;
    TimeLeft time_left_{1};
    std::int64_t n_steps_ = 1;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_ = start_;
};

/// A "warning" before a run, without value and threshold.
void json_note(const std::string& text);

/// "error", of a program that ends by one with this exit code.
void json_error(const std::exception& error, int exit_code);

}  // namespace abut::apps
