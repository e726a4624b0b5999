#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "abut/dynamics/integrator.hpp"
#include "abut/run/observer.hpp"
#include "abut/run/steps/start.hpp"
#include "abut/run/steps/whole_run.hpp"

namespace abut::run {

/// Throws BadInput for a time of RunOptions::times after the end of the run [s]; `check` has judged the rest.
void check_output_times(const RunOptions& options, double end);

/// State of this rank and of the solid before a step.
struct StepStart {
    dynamics::IntegratorState motion;
    std::vector<std::byte> solid;  // the same on all ranks
};

/// Shows an observer the bodies at RunOptions::times, as Observer::see_at_time says: on the straight path of the step in
/// which a time lies. The steps of the run stay as they are. All functions except `is_due`, `skip` and `forget_solid` are
/// calls of all ranks.
template <int Dim>
class OutputTimes {
public:
    /// All must outlive it. The start may take another part.
    OutputTimes(const Start<Dim>& start, const WholeRun<Dim>& whole, Observer<Dim>& observer)
        : start_(start), whole_(whole), observer_(observer) {}

    /// Whether a time is left until the node after so many steps [s]; the last node, whose time is a sum, takes all.
    [[nodiscard]] bool is_due(double node, std::int64_t steps) const;
    /// Times until this node were shown by the run that this one goes on from.
    void skip(double node, std::int64_t steps);
    /// Times at the start of the run, where it is in this state.
    void show_start(dynamics::IntegratorState state);
    /// Times in the step that has led to `end`.
    void show(const StepStart& start, const dynamics::IntegratorState& end);

    /// The solid of the run has other cells from now on.
    void forget_solid() { other_.reset(); }

private:
    [[nodiscard]] bool is_at_or_before(double time, double node) const;
    [[nodiscard]] double next() const { return start_.options.times[n_shown_]; }
    /// The velocity of the path as momenta.
    void set_momenta(const StepStart& start, dynamics::IntegratorState& state) const;
    void show_to_observer(const dynamics::IntegratorState& state, solid::Solid<Dim>& solid);
    void show_inside(const StepStart& start, const dynamics::IntegratorState& state);
    [[nodiscard]] solid::Solid<Dim>& other_solid();

    const Start<Dim>& start_;
    const WholeRun<Dim>& whole_;
    Observer<Dim>& observer_;
    std::size_t n_shown_ = 0;
    std::unique_ptr<solid::Solid<Dim>> other_;  // from the first time inside a step on
};

}  // namespace abut::run
