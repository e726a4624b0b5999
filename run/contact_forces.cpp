#include "abut/run/contact_forces.hpp"

#include <cmath>

#include "abut/dynamics/ledger.hpp"
#include "abut/run/scene.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {

template <int Dim>
ContactForces<Dim>::ContactForces(const Scene<Dim>& scene, const RunResult<Dim>& result)
    : interval_(scene.outputs.interval > 0 ? scene.outputs.interval : result.options.interval), n_steps_(result.steps) {}

template <int Dim>
bool ContactForces<Dim>::wants_look(std::int64_t step) const {
    return std::isnan(time_) || step % interval_ == 0 || step == n_steps_;
}

template <int Dim>
std::vector<ForceRow<Dim>> ContactForces<Dim>::rows(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
    const bool is_start = std::isnan(time_);
    const double seconds = run.time - time_;
    time_ = run.time;
    std::vector<ForceRow<Dim>> rows;
    for (const solid::BodyImpulse<Dim>& pair : solid.contact_impulses()) {
        const auto [last, is_new] = last_.try_emplace({pair.body_1, pair.body_2}, pair);
        const Vector<Dim> before = is_new ? Vector<Dim>(Vector<Dim>::Zero()) : last->second.impulse;
        const double normal_before = is_new ? 0.0 : last->second.normal_impulse;
        last->second = pair;
        if (is_start) continue;
        if (pair.impulse == before && pair.normal_impulse == normal_before) continue;
        ForceRow<Dim> row{.step = run.steps, .time = run.time, .body_1 = pair.body_1, .body_2 = pair.body_2};
        for (int i = 0; i < Dim; ++i) row.force[i] = (pair.impulse[i] - before[i]) / seconds;
        row.normal_force = (pair.normal_impulse - normal_before) / seconds;
        rows.push_back(row);
    }
    return rows;
}

template <int Dim>
void ContactForces<Dim>::save(StateWriter& state) const {
    state.put(time_);
    state.put(static_cast<std::int32_t>(last_.size()));
    for (const auto& [bodies, pair] : last_) {
        state.put(bodies.first);
        state.put(bodies.second);
        for (const double value : pair.impulse) state.put(value);
        state.put(pair.normal_impulse);
    }
}

template <int Dim>
void ContactForces<Dim>::restore(StateReader& state) {
    time_ = state.get<double>();
    for (auto n = state.get<std::int32_t>(); n > 0; --n) {
        solid::BodyImpulse<Dim> pair{};
        pair.body_1 = state.get<std::int32_t>();
        pair.body_2 = state.get<std::int32_t>();
        for (double& value : pair.impulse) value = state.get<double>();
        pair.normal_impulse = state.get<double>();
        last_.emplace(std::pair(pair.body_1, pair.body_2), pair);
    }
}

template class ContactForces<2>;
template class ContactForces<3>;

}  // namespace abut::run
