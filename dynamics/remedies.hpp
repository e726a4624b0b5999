#pragma once
#include <cstdint>
#include <optional>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/neutral_restart.hpp"

namespace abut::dynamics {

/// Remedies against the alternating mode of MEMM, as a run has them: the energy-neutral filter, and neutral restarts every
/// `restart` steps (0: none). System and remedies must outlive the integrator. docs/filter.md.
template <class S>
class Remedies {
public:
    /// Throws BadInput for a number of steps below 0, and as NeutralRestart.
    Remedies(S& system, bool filter, int restart) : system_(system), restart_period_(restart) {
        if (filter) filter_.emplace(system);
        go_on_from(0, {});
    }
    Remedies(const Remedies&) = delete;
    Remedies& operator=(const Remedies&) = delete;

    /// A run goes on after so many steps, in which restarts have reported this.
    void go_on_from(std::int64_t steps, const RestartReport& report) {
        if (restart_period_ != 0)
            restart_.emplace(system_,
                             RestartOptions{.period = restart_period_, .steps_before = steps, .report_before = report});
    }

    /// They act in the steps of this integrator from now on, each where its scheme takes it.
    template <class Integrator>
    void prepare(Integrator& integrator) {
        if constexpr (Integrator::takes_after_step)
            if (filter_)
                integrator.set_after_step(
                    [this](auto q, double dt, auto before, auto after) { (*filter_)(q, dt, before, after); });
        if constexpr (Integrator::takes_node_restart)
            if (restart_)
                integrator.set_node_restart(
                    [this](auto q, double dt, auto before, auto after) { (*restart_)(q, dt, before, after); });
    }

    /// Report of all restarts so far.
    [[nodiscard]] RestartReport report() const { return restart_ ? restart_->report() : RestartReport{}; }

private:
    S& system_;
    int restart_period_;
    std::optional<NeutralFilter<S>> filter_;
    std::optional<NeutralRestart<S>> restart_;
};

}  // namespace abut::dynamics
