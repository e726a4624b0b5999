#pragma once
#include <initializer_list>
#include <string>
#include <vector>

#include "abut/run/observer.hpp"
#include "abut/run/words/warnings.hpp"

namespace abut::apps {

/// Warnings as lines of the log, notes among them. `run` says which one of several it was: "100 cells".
void log_warnings(const std::vector<run::Warning>& warnings, const std::string& run = "");

/// Warnings of some kinds.
[[nodiscard]] std::vector<run::Warning> only(std::vector<run::Warning> warnings,
                                             std::initializer_list<run::WarningKind> kinds);

/// How much there is to do, and what is not as it should be: at the start, and once when a body is past a
/// rim or together with itself, or faces are strongly compressed.
template <int Dim>
class RunLog : public run::Observer<Dim> {
public:
    void begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) override;
    void record(const dynamics::LedgerEntry<Dim>& entry, const run::RunResult<Dim>& result) override;
    [[nodiscard]] bool wants_look(std::int64_t) const override { return false; }

private:
    bool warned_of_compression_ = false;
    std::size_t sightings_said_ = 0;
};

}  // namespace abut::apps
