#include "abut/run/steps/output_times.hpp"

#include <fmt/format.h>

#include <span>

#include "abut/base/error.hpp"
#include "abut/run/options.hpp"

namespace abut::run {
namespace {

constexpr double rounding_of_end = 1e-12;
constexpr double same_as_node = 1e-6;  // of a step: so near a node a time is at it, as sums of steps are rounded

}  // namespace

void check_output_times(const RunOptions& options, double end) {
    for (std::size_t i = 0; i < options.times.size(); ++i)
        if (const double time = options.times[i]; time > (1.0 + rounding_of_end) * end)
            throw BadInput(fmt::format("--times: number {} is {:.6g} s, and the run ends at {:.6g} s. Leave it out, or "
                                       "give a later end.",
                                       i + 1, time, end),
                           {.value = time, .allowed = end});
}

template <int Dim>
bool OutputTimes<Dim>::is_at_or_before(double time, double node) const {
    return time <= node + same_as_node * start_.result.run.dt;
}

template <int Dim>
bool OutputTimes<Dim>::is_due(double node, std::int64_t steps) const {
    return n_shown_ < start_.options.times.size() && (steps >= start_.result.run.steps || is_at_or_before(next(), node));
}

template <int Dim>
void OutputTimes<Dim>::skip(double node, std::int64_t steps) {
    while (is_due(node, steps)) ++n_shown_;
}

template <int Dim>
void OutputTimes<Dim>::show_start(dynamics::IntegratorState state) {
    for (const double node = state.time; is_due(node, 0); ++n_shown_) {
        state.time = next();
        show_to_observer(state, *start_.solid);
    }
}

template <int Dim>
void OutputTimes<Dim>::show(const StepStart& start, const dynamics::IntegratorState& end) {
    dynamics::IntegratorState state = end;
    set_momenta(start, state);
    for (; is_due(end.time, end.steps); ++n_shown_) {
        state.time = next();
        state.q = end.q;
        if (is_at_or_before(end.time, state.time)) {
            show_to_observer(state, *start_.solid);
            continue;
        }
        const double share = (state.time - start.motion.time) / end.dt;
        for (std::size_t i = 0; i < state.q.size(); ++i)
            state.q[i] = start.motion.q[i] + share * (end.q[i] - start.motion.q[i]);
        show_inside(start, state);
    }
}

template <int Dim>
void OutputTimes<Dim>::set_momenta(const StepStart& start, dynamics::IntegratorState& state) const {
    const std::span<const double> masses = start_.solid->masses();
    for (std::size_t i = 0; i < state.q.size(); ++i)
        state.p_before[i] = state.p_after[i] = masses[i / Dim] * (state.q[i] - start.motion.q[i]) / state.dt;
}

template <int Dim>
void OutputTimes<Dim>::show_to_observer(const dynamics::IntegratorState& state, solid::Solid<Dim>& solid) {
    const dynamics::RunView<Dim> run(state);
    whole_.show(run, solid, [&](const auto& sight) { observer_.see_at_time(sight); });
    if (solid.ranks().is_one()) observer_.look_at_time(run, solid);
}

/// With loads, obstacles and what materials and friction remember as they are then: another solid goes there from the
/// start of the step, and that of the run knows nothing of it.
template <int Dim>
void OutputTimes<Dim>::show_inside(const StepStart& start, const dynamics::IntegratorState& state) {
    solid::Solid<Dim>& solid = other_solid();
    const dynamics::IntegratorState& from = start.motion;
    solid.restore(start.solid, from.q);
    std::vector<double> force(state.q.size());
    const double dt = state.time - from.time;
    if (features_of(start_.options).has(solid::Feature::end_forces))
        solid.end_force(from.q, state.q, from.time, dt, force);
    else
        solid.mean_force(from.q, state.q, from.time, dt, force);
    show_to_observer(state, solid);
}

template <int Dim>
solid::Solid<Dim>& OutputTimes<Dim>::other_solid() {
    const solid::Solid<Dim>& solid = *start_.solid;
    if (!other_) other_ = std::make_unique<solid::Solid<Dim>>(solid.mesh(), solid.options(), solid.ranks());
    return *other_;
}

template class OutputTimes<2>;
template class OutputTimes<3>;

}  // namespace abut::run
