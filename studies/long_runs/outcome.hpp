#pragma once
#include <cmath>
#include <ctime>
#include <string>

#include "studies/table/figures.hpp"

namespace abut::studies::long_runs {

/// Remedy against the alternating mode of MEMM.
struct Remedy {
    std::string name;
    bool filter = false;
    int restart = 0;  ///< steps from one neutral restart to the next; 0: none
};

/// Figures of a run under one remedy, largest values of every 101st step; `pseudo_angular` is that of J~, `seconds` are
/// of all processors, with what is measured.
struct Outcome : Figures {
    double excess_end = run::not_given;  ///< H - H~, mean of the last tenth of the run
    dynamics::RestartReport restarts;    ///< `paid` over the scale
};

/// Seconds of all processors since it was made, whoever else is on the machine.
class ProcessorTime {
public:
    [[nodiscard]] double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
    std::clock_t start_ = std::clock();
};

/// Outcome of a run that was to take so many steps, as its ledger tells it; energies are over `scale` [J].
template <int Dim>
[[nodiscard]] Outcome outcome_of(const dynamics::Ledger<Dim>& ledger, double scale, std::int64_t steps) {
    const dynamics::LedgerEntry<Dim>& last = ledger.entries().back();
    Outcome outcome{{.steps = last.step,
                     .drift = ledger.pseudo_energy_drift() / scale,
                     .excess = ledger.energy_excess() / scale,
                     .parasitic = ledger.parasitic(),
                     .events = last.events}};
    outcome.restarts = last.restarts;
    outcome.restarts.paid /= scale;
    double sum = 0.0;
    int n = 0;
    for (const auto& entry : ledger.entries())
        if (entry.step >= steps - steps / 10) sum += (entry.energy - entry.pseudo_energy) / scale, ++n;
    if (n > 0) outcome.excess_end = sum / n;
    return outcome;
}

}  // namespace abut::studies::long_runs
