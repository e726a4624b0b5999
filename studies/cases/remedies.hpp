#pragma once
#include <algorithm>

#include "abut/dynamics/filter.hpp"
#include "abut/dynamics/neutral_restart.hpp"

namespace abut::studies {

/// Remedies against the alternating mode of MEMM on a host: the energy-neutral filter, neutral restarts every `period` steps
/// (0: none). They must outlive the integrator.
template <class Host>
class Remedies {
public:
    Remedies(Host& host, bool filter, int period)
        : filter_(host), restart_(host, {.period = std::max(1, period)}), filters_(filter), restarts_(period > 0) {}

    /// Other schemes are left as they are.
    template <class Integrator>
    void prepare(Integrator& integrator) {
        if constexpr (Integrator::takes_node_restart) {
            if (filters_)
                integrator.set_after_step(
                    [&](auto q, double dt, auto before, auto after) { filter_(q, dt, before, after); });
            if (restarts_)
                integrator.set_node_restart(
                    [&](auto q, double dt, auto before, auto after) { restart_(q, dt, before, after); });
        }
    }
    [[nodiscard]] const dynamics::RestartReport& report() const { return restart_.report(); }

private:
    dynamics::NeutralFilter<Host> filter_;
    dynamics::NeutralRestart<Host> restart_;
    bool filters_, restarts_;
};

}  // namespace abut::studies
