#pragma once
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string>

#include "abut/dynamics/ledger.hpp"

namespace abut::studies::long_runs {

/// What is done against the alternating mode of MEMM.
struct Remedy {
    std::string name;
    bool filter = false;
    int restart = 0;  ///< steps from one neutral restart to the next; 0: none
};

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A run under one remedy; energies over the scale of the scene. Largest values of every 101st step.
struct Outcome {
    std::int64_t steps = 0;       ///< taken
    double excess_max = 0.0;      ///< max (H - H~)
    double excess_end = unknown;  ///< H - H~, mean of the last tenth of the run
    double parasitic = 0.0;       ///< max |e|/m [m/s]
    double drift = 0.0;           ///< max |H~ - H~0 - work|
    double momentum = unknown;    ///< its drift over sum |p| at the start; unknown where walls act
    double spin = unknown;        ///< the same of J~ over sum |x × p|
    std::int64_t events = 0;      ///< contacts begun or ended
    dynamics::RestartReport restarts;
    double seconds = 0.0;  ///< of all processors, with what is measured
    std::string end;       ///< why before its time; empty: it came to its end
};

/// Seconds of all processors since it was made, whoever else is on the machine.
class ProcessorTime {
public:
    [[nodiscard]] double seconds() const { return static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
    std::clock_t start_ = std::clock();
};

/// Keeps what an outcome needs of ledger entries.
template <int Dim>
class Figures {
public:
    explicit Figures(double scale, std::int64_t steps) : scale_(scale), last_tenth_(steps - steps / 10) {}

    void record(const dynamics::LedgerEntry<Dim>& entry) {
        const double kept = entry.pseudo_energy - entry.work, excess = (entry.energy - entry.pseudo_energy) / scale_;
        if (std::isnan(first_)) first_ = kept;
        outcome_.steps = entry.step;
        outcome_.excess_max = std::fmax(outcome_.excess_max, excess);
        outcome_.parasitic = std::fmax(outcome_.parasitic, entry.parasitic);
        outcome_.drift = std::fmax(outcome_.drift, std::abs(kept - first_) / scale_);
        outcome_.events = entry.events;
        outcome_.restarts = entry.restarts;
        outcome_.restarts.paid /= scale_;
        if (entry.step < last_tenth_) return;
        excess_sum_ += excess;
        outcome_.excess_end = excess_sum_ / ++n_last_;
    }
    [[nodiscard]] Outcome& outcome() { return outcome_; }

private:
    double scale_;
    std::int64_t last_tenth_;
    double first_ = unknown;
    double excess_sum_ = 0.0;
    int n_last_ = 0;
    Outcome outcome_;
};

}  // namespace abut::studies::long_runs
