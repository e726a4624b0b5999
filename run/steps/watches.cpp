#include "abut/run/steps/watches.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/stopwatch.hpp"
#include "abut/run/body_names.hpp"
#include "abut/run/values/gathered_cells.hpp"
#include "abut/solid/all_points.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/contact_view.hpp"

namespace abut::run {
namespace {

constexpr std::int64_t sightings_per_run = 40;  // looks for bodies past a rim and together with themselves, about

}  // namespace

template <int Dim>
Watches<Dim>::Watches(Start<Dim>& start, const WholeRun<Dim>& whole)
    : start_(start),
      whole_(whole),
      obstacles_(start.scene, start.solid->ranks()),
      friction_(start.scene, start.options),
      self_(std::in_place, start.scene, *start.solid),
      surfaces_(std::in_place, start.scene) {}

template <int Dim>
void Watches<Dim>::take_rest() {
    fine_motion_.reset();
    self_.emplace(start_.present(), *start_.solid);
    const SurfaceWatch<Dim> before = *surfaces_;
    surfaces_.emplace(start_.present());
    SurfaceWatch<Dim>::fields(*surfaces_) = SurfaceWatch<Dim>::fields(before);
}

template <int Dim>
void Watches<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, std::span<const double> q) {
    friction_.record(entry, start_.solid->contact().impulses(), start_.result.energy.accounts.speed);
    if (!start_.result.bodies.all_may_turn) record_turned(q);
}

template <int Dim>
void Watches<Dim>::record_turned(std::span<const double> q) {
    RunResult<Dim>& result = start_.result;
    const std::vector<double> angles = start_.solid->rotations(q);
    for (std::size_t body = 0; body < angles.size(); ++body)
        if (!result.bodies.may_turn[body] && angles[body] > result.watch.turned.angle)
            result.watch.turned = {quoted_name(start_.scene, static_cast<std::int32_t>(body)), angles[body]};
}

/// At the end, and at evenly spaced records before it: a look at fine motion costs about a tenth of a step, and the lists
/// for the first one less than a step (27,000 bricks, or as many tetrahedra).
template <int Dim>
bool Watches<Dim>::is_sighting_due(std::int64_t step) const {
    const std::int64_t interval = start_.options.interval, steps = start_.result.run.steps;
    const std::int64_t every = interval * std::max<std::int64_t>(1, steps / (interval * sightings_per_run));
    return step % every == 0 || step == steps;
}

template <int Dim>
void Watches<Dim>::look_at_obstacles(std::span<const double> q, double time) {
    obstacles_.look(*start_.solid, q, time, start_.result.watch.sightings.past_rims);
}

template <int Dim>
void Watches<Dim>::look_around(const dynamics::RunView<Dim>& run) {
    if (!is_sighting_due(run.steps)) return;
    const Stopwatch watch(start_.result.seconds.looks);
    look_at_obstacles(run.q, run.time);
    if (self_->is_on()) look_for_crossings(run);
    look_at_fine_motion(run);
}

/// The surfaces are brought together only where a body has deformed enough.
template <int Dim>
void Watches<Dim>::look_for_crossings(const dynamics::RunView<Dim>& run) {
    const dynamics::Ranks& ranks = start_.solid->ranks();
    bool due = false;
    {
        const solid::AllPoints<Dim> points(run, *start_.solid);
        due = first_says(ranks, [&] { return self_->is_due(points, run.steps) ? 1 : 0; }) != 0;
    }
    if (!due) return;
    whole_.show(
        run, [&](const auto& sight) { self_->look(sight, start_.result.watch.sightings); }, Evaluated::cells_alone);
}

/// Neighbours of cells are listed at the first look.
template <int Dim>
void Watches<Dim>::look_at_fine_motion(const dynamics::RunView<Dim>& run) {
    const solid::Solid<Dim>& solid = *start_.solid;
    const mesh::Mesh<Dim>& whole = start_.present().mesh;
    const std::vector<Vector<Dim>> of_part = solid.cells().velocity(run.p_after);
    const auto velocity = GatheredCells<Dim>(solid, whole).template cells<Vector<Dim>>([&](std::int32_t c) {
        return of_part[static_cast<std::size_t>(c)];
    });
    whole_.on_first([&] {
        if (!fine_motion_) fine_motion_.emplace(whole);
        double& most = start_.result.energy.fine_max;
        most = std::max(most, fine_motion_->energy(whole, solid.options().materials, velocity));
    });
}

template <int Dim>
void Watches<Dim>::look_at_surfaces(const dynamics::RunView<Dim>& run) {
    RunResult<Dim>& result = start_.result;
    const Stopwatch watch(result.seconds.looks);
    const bool touch = result.contact.report.active_pairs > 0;
    whole_.show(
        run, [&](const auto& sight) { surfaces_->look(sight, result.energy.accounts.speed, touch); }, Evaluated::yes);
}

template <int Dim>
void Watches<Dim>::end(const Sight<Dim>& sight, const contact::ContactReport& contact) {
    surfaces_->end(sight, start_.result.energy.accounts.speed, contact.active_pairs > 0, contact.active_pairs_max > 0);
}

template <int Dim>
void Watches<Dim>::take_figures() const {
    start_.result.watch.looks = surfaces_->looks();
    start_.result.watch.weak_friction = friction_.weakest();
}

template class Watches<2>;
template class Watches<3>;

}  // namespace abut::run
