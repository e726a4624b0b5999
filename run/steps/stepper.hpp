#pragma once
// Private to the layer.
#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "abut/dynamics/remedies.hpp"
#include "abut/run/steps/start.hpp"
#include "abut/solid/change.hpp"

namespace abut::run {

/// The integrator of a run, with its remedies and the times of its solid. Another solid may come into the place of the one
/// that Start has; the run then goes on with another integrator.
template <int Dim, class Integrator>
class Stepper {
public:
    /// `make` makes the integrator of a start, which must outlive the stepper.
    Stepper(Start<Dim>& start, std::function<Integrator(Start<Dim>&)> make)
        : start_(start),
          make_(std::move(make)),
          remedies_(std::in_place, solid(), start.options.filter, start.options.restart),
          integrator_(make_(start)),
          times_of_setup_(solid().times()) {
        remedies_->prepare(*integrator_);
    }

    [[nodiscard]] Integrator& operator*() { return *integrator_; }
    [[nodiscard]] const Integrator& operator*() const { return *integrator_; }
    [[nodiscard]] Integrator* operator->() { return &*integrator_; }
    [[nodiscard]] const Integrator* operator->() const { return &*integrator_; }

    [[nodiscard]] dynamics::RestartReport restarts() const { return remedies_->report(); }
    /// Times of the solids of all steps so far.
    [[nodiscard]] solid::SolidTimes times() const { return added(times_before_, solid().times(), times_of_setup_); }
    /// Time of this rank in the operators of its cells, since the last call [s].
    [[nodiscard]] double own_seconds() {
        return solid().times().own_cells - std::exchange(own_seconds_before_, solid().times().own_cells);
    }

    // In front of an error

    [[nodiscard]] std::string at_this_time(const std::string& what) const {
        return fmt::format("step {}, t = {:.4g} s: {}", integrator_->steps(), integrator_->time(), what);
    }
    /// In the step that begins now.
    [[nodiscard]] std::string at_this_step(const std::string& what) const {
        return fmt::format("step {}, t = {:.4g} s (steps of {:.4g} s, stable are {:.4g} s): {}", integrator_->steps() + 1,
                           integrator_->time(), start_.result.run.dt, start_.result.run.stable.dt, what);
    }

    // Other states and solids

    /// Goes on from this state of the run, in which restarts had reported this. A call of all ranks.
    void go_on_from(const solid::RunState& state, const dynamics::RestartReport& restarts) {
        solid::go_on_from(state, solid(), *integrator_);
        take_remedies(restarts);
        times_of_setup_ = solid().times();
    }
    /// Start has another solid, at the start of its run.
    void take_solid() {
        remedies_.reset();
        integrator_.emplace(make_(start_));
    }
    /// Goes on with the solid that change() gives to Start, from the state that it returns. A call of all ranks.
    template <class Change>
    void change_solid(const Change& change) {
        const solid::SolidTimes times = solid().times();
        const dynamics::RestartReport so_far = restarts();
        const solid::RunState state = change();
        times_before_ = added(times_before_, times, times_of_setup_);
        take_solid();
        go_on_from(state, so_far);
        own_seconds_before_ = times_of_setup_.own_cells;
    }

private:
    [[nodiscard]] solid::Solid<Dim>& solid() { return *start_.solid; }
    [[nodiscard]] const solid::Solid<Dim>& solid() const { return *start_.solid; }
    void take_remedies(const dynamics::RestartReport& restarts) {
        remedies_.emplace(solid(), start_.options.filter, start_.options.restart);
        remedies_->go_on_from(integrator_->steps(), restarts);
        remedies_->prepare(*integrator_);
    }

    Start<Dim>& start_;
    std::function<Integrator(Start<Dim>&)> make_;
    std::optional<dynamics::Remedies<solid::Solid<Dim>>> remedies_;  // none of a solid that has just been taken
    std::optional<Integrator> integrator_;                           // always there
    solid::SolidTimes times_of_setup_;  // the start-up of the scheme, in the seconds of set-up already
    solid::SolidTimes times_before_;    // of steps with other solids
    double own_seconds_before_ = 0.0;
};

}  // namespace abut::run
