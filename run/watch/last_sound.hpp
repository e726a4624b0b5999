#pragma once
// Private to the layer.
#include <span>
#include <utility>
#include <vector>

#include "abut/dynamics/integrator.hpp"

namespace abut::run {

/// The last state of a run in which nothing was wrong: Failure::sound, except what only the scheme knows.
class LastSound {
public:
    /// The present state; without allocation from one call to the next.
    template <class Integrator>
    void keep(const Integrator& integrator, double dt) {
        const auto copy = [](std::span<const double> from, std::vector<double>& to) { to.assign(from.begin(), from.end()); };
        copy(integrator.q(), state_.q);
        copy(integrator.p_before(), state_.p_before);
        copy(integrator.p_after(), state_.p_after);
        state_.dt = dt;
        state_.time = integrator.time();
        state_.steps = integrator.steps();
        is_kept_ = true;
    }
    void replace(dynamics::IntegratorState state) { state_ = std::move(state); }

    [[nodiscard]] bool is_kept() const { return is_kept_; }  ///< once at least
    [[nodiscard]] const dynamics::IntegratorState& state() const { return state_; }

private:
    dynamics::IntegratorState state_;
    bool is_kept_ = false;
};

}  // namespace abut::run
