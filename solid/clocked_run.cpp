#include "abut/solid/clocked_run.hpp"

#include <algorithm>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/solid/outside_view.hpp"

namespace abut::solid {

template <int Dim>
ClockedRun<Dim>::ClockedRun(SteppedRun<Dim>& run, LoadImpulse impulse) : run_(run), impulse_(impulse), clock_(run.memm()) {
    for (const TractionCondition<Dim>& condition : run_.solid().options().boundary.traction) {
        if (!condition.from_outside) continue;
        const std::span<const Vector<Dim>> traction = run_.solid().outside(condition.group).traction();
        const std::vector<Vector<Dim>> nothing(traction.size(), Vector<Dim>::Zero());
        loads_.push_back({condition.group, {traction.begin(), traction.end()}, nothing, nothing, nothing});
    }
}

template <int Dim>
typename ClockedRun<Dim>::Load& ClockedRun<Dim>::load_on(const std::string& group) {
    return *std::ranges::find(loads_, group, &Load::group);
}

template <int Dim>
void ClockedRun<Dim>::set_traction(const std::string& group, std::span<const Vector<Dim>> traction) {
    run_.solid().set_traction(group, traction);  // which knows groups and their sizes; at the node the mean takes its place
    load_on(group).traction.assign(traction.begin(), traction.end());
}

/// Tractions act for s within a step.
template <int Dim>
void ClockedRun<Dim>::add_piece(double s) {
    const double share = s / (clock_.since() + s);  // of the time since the node; 1 where it begins there
    for (Load& load : loads_) {
        if (!has_begun_) load.at_node = load.mean_before = load.traction;
        if (share == 1.0) load.mean = load.traction;
        for (std::size_t face = 0; face < load.mean.size(); ++face)
            load.mean[face] += share * (load.traction[face] - load.mean[face]);
    }
    has_begun_ = true;
}

/// The traction of the step that ends. One that stays is given as it is, to the bit: it costs nothing then.
template <int Dim>
void ClockedRun<Dim>::set_mean(Load& load) {
    std::vector<Vector<Dim>> mean = load.mean;
    if (impulse_ == LoadImpulse::trapezoid)
        for (std::size_t face = 0; face < mean.size(); ++face) {
            const Vector<Dim> next = load.mean[face] + 0.5 * (load.mean[face] - load.mean_before[face]);
            mean[face] = 0.5 * (load.at_node[face] + next);
            load.at_node[face] = next;
            load.mean_before[face] = load.mean[face];
        }
    run_.solid().set_traction(load.group, mean);
}

/// Else ranks would wait for ever for a step that others do not take.
template <int Dim>
void ClockedRun<Dim>::require_same(double d) const {
    const dynamics::Ranks& ranks = run_.solid().ranks();
    if (ranks.is_one()) return;
    const double most = ranks.largest(d), least = -ranks.largest(-d);
    if (most != least)
        throw BadInput("ClockedRun: ranks give times from " + exact_number(least) + " to " + exact_number(most) +
                           " s. Give the same on all of them.",
                       {.value = most, .allowed = least});
}

template <int Dim>
void ClockedRun<Dim>::advance(double d) {
    require_same(d);
    const auto node = [&] {
        for (Load& load : loads_) set_mean(load);
    };
    clock_.advance(
        d, [&](double s) { add_piece(s); }, node, [&] { run_.step(); });
}

template <int Dim>
std::vector<Vector<Dim>> ClockedRun<Dim>::motion(const std::string& group, double d) {
    require_same(d);
    constexpr double nearness = 1e-9;  // of the step
    dynamics::Memm<Solid<Dim>>& memm = run_.memm();
    if (!(d > 0.0) || d > time_to_node() + nearness * memm.dt())
        throw BadInput("the motion of '" + group + "' over " + number(d) + " s: it is known for " + number(time_to_node()) +
                           " s, until the next node of the solid. Ask for a time > 0 up to that (time_to_node).",
                       {.value = d, .allowed = time_to_node()});
    std::vector<Vector<Dim>> motion = step_motion(group);
    for (Vector<Dim>& of_face : motion) of_face *= d / memm.dt();
    return motion;
}

template <int Dim>
std::vector<Vector<Dim>> ClockedRun<Dim>::step_motion(const std::string& group) {
    dynamics::Memm<Solid<Dim>>& memm = run_.memm();
    return run_.solid().outside(group).motion(memm.q(), memm.next_q(), memm.time(), memm.dt());
}

template <int Dim>
OutsideFaces<Dim> ClockedRun<Dim>::faces(const std::string& group) {
    const double tau = run_.memm().dt();
    OutsideFaces<Dim> faces = outside_faces<Dim>(run_.memm(), run_.solid(), group);
    const std::vector<Vector<Dim>> motion = step_motion(group);
    for (std::size_t face = 0; face < motion.size(); ++face) {
        faces.position[face] += clock_.since() / tau * motion[face];
        faces.velocity[face] = motion[face] / tau;
    }
    faces.traction = load_on(group).traction;  // the solid has the mean of the last step
    return faces;
}

template <int Dim>
typename ClockedRun<Dim>::State ClockedRun<Dim>::state() const {
    State state{run_state(run_.solid(), run_.memm()), run_.restarts(), clock_.time(), {}};
    for (const Load& load : loads_)
        for (const std::vector<Vector<Dim>>* values : load.all())
            state.loads.push_back(run_.solid().outside(load.group).gather(std::span<const Vector<Dim>>(*values)));
    state.has_begun = has_begun_;
    return state;
}

template <int Dim>
void ClockedRun<Dim>::restore(const State& state) {
    std::vector<Load> loads = dynamics::agreed(run_.solid().ranks(), [&] { return loads_of(state); });
    run_.restore(state.run, state.restarts);
    clock_.restore(state.time);
    loads_ = std::move(loads);
    has_begun_ = state.has_begun;
}

/// Loads of a state, if it is one of this run.
template <int Dim>
auto ClockedRun<Dim>::loads_of(const State& state) const -> std::vector<Load> {
    const auto is_of_this_run = [&] {
        if (state.loads.size() != 4 * loads_.size()) return false;
        for (std::size_t i = 0; i < state.loads.size(); ++i)
            if (state.loads[i].size() != run_.solid().outside(loads_[i / 4].group).n_all()) return false;
        return true;
    };
    if (!is_of_this_run())
        throw BadInput(
            "ClockedRun: the state has loads on other groups or faces than this run. Restore one that it has given.");
    const dynamics::IntegratorState& motion = state.run.motion;
    dynamics::detail::check_clock_time(state.time, motion.time, motion.time + motion.dt);
    std::vector<Load> loads = loads_;
    for (std::size_t i = 0; i < state.loads.size(); ++i) {
        Load& load = loads[i / 4];
        const std::span<const std::int32_t> numbers = run_.solid().outside(load.group).numbers();
        for (std::size_t face = 0; face < numbers.size(); ++face)
            (*load.all()[i % 4])[face] = state.loads[i][static_cast<std::size_t>(numbers[face])];
    }
    return loads;
}

template class ClockedRun<2>;
template class ClockedRun<3>;

}  // namespace abut::solid
