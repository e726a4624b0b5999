#include "abut/run/force_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "abut/run/body_names.hpp"
#include "abut/run/files.hpp"

namespace abut::run {

template <int Dim>
ForceFile<Dim>::ForceFile(std::filesystem::path path) : file_(std::move(path)) {}

template <int Dim>
void ForceFile<Dim>::look_up(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    names_ = scene.mesh.body_names;
    for (std::size_t i = 0; i < scene.solid.obstacles.size(); ++i) names_.push_back(name_of_obstacle(scene, i));
    for (std::string& name : names_) name = in_csv(name);
    interval_ = scene.outputs.interval > 0 ? scene.outputs.interval : result.options.interval;
    n_steps_ = result.steps;
}

template <int Dim>
void ForceFile<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    look_up(scene, result);
    file_.open();
    std::string columns = "step,time,body_1,body_2";
    for (int i = 0; i < Dim; ++i) columns += fmt::format(",force_{}", "xyz"[i]);
    file_.write(columns + ",normal_force\n");
}

template <int Dim>
bool ForceFile<Dim>::wants_look(std::int64_t step) const {
    return std::isnan(time_) || step % interval_ == 0 || step == n_steps_;
}

template <int Dim>
void ForceFile<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    const bool is_start = std::isnan(time_);
    if (!wants_look(run.steps)) return;
    const double seconds = run.time - time_;
    time_ = run.time;
    for (const solid::BodyImpulse<Dim>& pair : solid.contact_impulses()) {
        const auto [last, is_new] = last_.try_emplace({pair.body_1, pair.body_2}, pair);
        const Vector<Dim> before = is_new ? Vector<Dim>(Vector<Dim>::Zero()) : last->second.impulse;
        const double normal_before = is_new ? 0.0 : last->second.normal_impulse;
        last->second = pair;
        if (is_start) continue;
        if (pair.impulse == before && pair.normal_impulse == normal_before) continue;
        std::string row = fmt::format("{},{:.17g},{},{}", run.steps, run.time, names_[static_cast<std::size_t>(pair.body_1)],
                                      names_[static_cast<std::size_t>(pair.body_2)]);
        for (int i = 0; i < Dim; ++i) row += fmt::format(",{:.17g}", (pair.impulse[i] - before[i]) / seconds);
        file_.write(fmt::format("{},{:.17g}\n", row, (pair.normal_impulse - normal_before) / seconds));
    }
}

template <int Dim>
void ForceFile<Dim>::save(StateWriter& state) {
    state.put(static_cast<std::uint64_t>(file_.size()));
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
void ForceFile<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    look_up(scene, result);
    file_.go_on_after(state.get<std::uint64_t>());
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

template <int Dim>
void ForceFile<Dim>::finish() {
    file_.finish();
}

template class ForceFile<2>;
template class ForceFile<3>;

}  // namespace abut::run
