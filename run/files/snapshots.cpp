#include "abut/run/files/snapshots.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/failure.hpp"
#include "abut/solid/contact_view.hpp"

namespace abut::run {
namespace {

constexpr std::int64_t looks_per_run = 60;
constexpr double worth_another = 1.05;  // times the force of the snapshot before

template <int Dim>
double normal_impulse(const solid::Solid<Dim>& solid) {
    double sum = 0.0;
    for (const solid::BodyImpulse<Dim>& pair : solid.contact().impulses()) sum += pair.normal_impulse;
    return sum;
}

}  // namespace

template <int Dim>
void Snapshots<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    maker_.emplace(scene, result);
    middle_step_ = result.run.steps / 2;
    const std::int64_t interval = result.options.interval;
    every_ = interval * std::max<std::int64_t>(1, result.run.steps / (interval * looks_per_run));
}

template <int Dim>
void Snapshots<Dim>::record(const dynamics::LedgerEntry<Dim>& entry) {
    in_contact_ = entry.active_pairs > 0;
}

template <int Dim>
bool Snapshots<Dim>::wants_look(std::int64_t step) const {
    return step == 0 || step == middle_step_ || (in_contact_ && step % every_ == 0);
}

template <int Dim>
void Snapshots<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    if (!wants_look(run.steps)) return;
    const bool is_start = run.steps == 0, is_middle = run.steps == middle_step_;
    double force = 0.0;
    if (is_start || run.steps % every_ == 0) {
        const double impulse = normal_impulse(solid);
        if (!is_start) force = (impulse - last_impulse_) / (run.time - last_time_);
        last_impulse_ = impulse;
        last_time_ = run.time;
    }
    const bool is_largest = force > (largest_ ? worth_another * largest_->force : 0.0);
    if (!is_start && !is_middle && !is_largest) return;
    static_cast<void>(solid.potential(run.q));  // leaves the stresses of this state behind
    if (is_start) start_ = maker_->taken("At the start", run, solid);
    if (is_middle && !is_start) middle_ = maker_->taken("In the middle", run, solid);
    if (!is_largest) return;
    largest_ = maker_->taken("Near the largest contact force", run, solid);
    largest_->force = force;
}

template <int Dim>
void Snapshots<Dim>::cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) {
    maker_->take_cells(solid.mesh(), first_cells);
}

template <int Dim>
void Snapshots<Dim>::end(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    end_ = maker_->taken("At the end", run, solid);
}

template <int Dim>
void Snapshots<Dim>::fail(const Failure& failure, solid::Solid<Dim>& solid) {
    solid.restore(solid.state(), failure.sound.q);  // contact was last searched where the run was lost
    static_cast<void>(solid.potential(failure.sound.q));
    end_ = maker_->taken("The last sound state", dynamics::RunView<Dim>(failure.sound), solid);
}

template <int Dim>
BodyPictures Snapshots<Dim>::pictures() const {
    BodyPictures pictures{.polygons = maker_ ? maker_->polygons() : BodyPolygons(), .snapshots = {}};
    for (const std::optional<Snapshot>* snapshot : {&start_, &middle_, &largest_, &end_})
        if (*snapshot) pictures.snapshots.push_back(**snapshot);
    std::ranges::stable_sort(pictures.snapshots, {}, &Snapshot::time);
    return pictures;
}

template class Snapshots<2>;
template class Snapshots<3>;

}  // namespace abut::run
