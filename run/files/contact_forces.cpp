#include "abut/run/files/contact_forces.hpp"

#include <cmath>
#include <utility>

#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/moment.hpp"

namespace abut::run {
namespace {

template <int Dim>
solid::BodyImpulse<Dim> none_yet(const solid::BodyImpulse<Dim>& pair) {
    return {.body_1 = pair.body_1, .body_2 = pair.body_2, .impulse = Vector<Dim>::Zero(), .normal_impulse = 0.0};
}

}  // namespace

template <int Dim>
ContactForces<Dim>::ContactForces(const Scene<Dim>& scene, const RunResult<Dim>& result)
    : interval_(scene.outputs.interval > 0 ? scene.outputs.interval : result.options.interval), n_steps_(result.run.steps) {}

template <int Dim>
bool ContactForces<Dim>::wants_look(std::int64_t step) const {
    return std::isnan(time_) || step % interval_ == 0 || step == n_steps_;
}

template <int Dim>
std::vector<ForceRow<Dim>> ContactForces<Dim>::rows(const Moment<Dim>& now) {
    const bool is_start = std::isnan(time_);
    const double seconds = now.time - time_;
    time_ = now.time;
    std::vector<ForceRow<Dim>> rows;
    for (const solid::BodyImpulse<Dim>& pair : now.impulses) {
        solid::BodyImpulse<Dim>& last = last_.try_emplace({pair.body_1, pair.body_2}, none_yet(pair)).first->second;
        const solid::BodyImpulse<Dim> before = std::exchange(last, pair);
        if (is_start) continue;
        if (pair.impulse == before.impulse && pair.normal_impulse == before.normal_impulse) continue;
        ForceRow<Dim> row{.step = now.steps, .time = now.time, .body_1 = pair.body_1, .body_2 = pair.body_2};
        for (int i = 0; i < Dim; ++i) row.force[i] = (pair.impulse[i] - before.impulse[i]) / seconds;
        row.normal_force = (pair.normal_impulse - before.normal_impulse) / seconds;
        row.friction = (pair.friction - before.friction) / seconds;
        const double rubbing_impulse = pair.rubbing_impulse - before.rubbing_impulse;
        row.rubbing_force = rubbing_impulse / seconds;
        if (rubbing_impulse > 0.0) row.slip_velocity = (pair.slip - before.slip) / rubbing_impulse;
        rows.push_back(row);
    }
    return rows;
}

template class ContactForces<2>;
template class ContactForces<3>;

}  // namespace abut::run
