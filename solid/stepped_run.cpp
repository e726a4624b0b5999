#include "abut/solid/stepped_run.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/throw_again.hpp"
#include "abut/solid/options/made_features.hpp"

namespace abut::solid {

template <int Dim>
SteppedRun<Dim>::SteppedRun(std::unique_ptr<Solid<Dim>> solid, std::vector<double> q, std::span<const double> p, double dt,
                            const RunRemedies& remedies)
    : given_(remedies), solid_(std::move(solid)) {
    require_together(solid_->mesh(), solid_->options(), {Feature::stepped_run});
    memm_.emplace(*solid_, std::move(q), p, dt);
    remedies_.emplace(*solid_, given_.filter, given_.restart);
    remedies_->prepare(*memm_);
}

template <int Dim>
void SteppedRun<Dim>::step() {
    try {
        memm_->step();
    } catch (const Error& error) {
        throw_again(error, at_step(memm_->steps() + 1, error.what()));
    }
}

template <int Dim>
std::string SteppedRun<Dim>::set_step(double dt, dynamics::StepChange change, const std::string& clock) {
    constexpr double slow_change = 0.05;  // of the step before
    const double before = memm_->dt();
    memm_->set_step(dt, change);
    if (has_warned_ || memm_->steps() == 0 || std::abs(dt - before) <= slow_change * before) return "";
    has_warned_ = true;
    return "the step changes from " + number(before) + " s to " + number(dt) +
           " s, by more than 5 %. Steps that jump feed the alternating mode, and H~ does not show it. Keep the step, and "
           "dictate times: " +
           clock + " (docs/loads.md, Times that are dictated).";
}

template <int Dim>
void SteppedRun<Dim>::record() {
    ledger_.record(dynamics::measure(*memm_, *solid_, remedies_->report()));
    const auto& entry = ledger_.entries().back();
    if (!std::isfinite(entry.energy) || !std::isfinite(entry.pseudo_energy))
        throw Diverged(at_step(memm_->steps(), "the run has diverged: its energy is not finite. Take a shorter step."));
}

template <int Dim>
void SteppedRun<Dim>::restore(const RunState& state, const dynamics::RestartReport& restarts) {
    go_on_from(state, *solid_, *memm_);
    remedies_->go_on_from(memm_->steps(), restarts);
}

template <int Dim>
Left<Dim> SteppedRun<Dim>::change(std::unique_ptr<Solid<Dim>> after, std::span<const std::int32_t> old_cells) {
    const Change<Dim> changed = solid::change(*solid_, memm_->state(), *after, old_cells);
    const dynamics::IntegratorState& motion = changed.state.motion;
    const dynamics::RestartReport restarts = remedies_->report();
    remedies_.reset();
    memm_.emplace(*after, motion.q, motion.p_after, motion.dt);
    solid_ = std::move(after);
    go_on_from(changed.state, *solid_, *memm_);
    remedies_.emplace(*solid_, given_.filter, given_.restart);
    remedies_->go_on_from(memm_->steps(), restarts);
    remedies_->prepare(*memm_);
    return changed.left;
}

template <int Dim>
std::string SteppedRun<Dim>::at_step(std::int64_t step, const char* what) const {
    return "step " + std::to_string(step) + ", t = " + std::to_string(memm_->time()) + " s: " + what;
}

template class SteppedRun<2>;
template class SteppedRun<3>;

}  // namespace abut::solid
