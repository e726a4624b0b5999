#include "abut/run/files/snapshots.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/sight.hpp"

namespace abut::run {
namespace {

constexpr std::int64_t looks_per_run = 60;
constexpr double worth_another = 1.05;  // times the force of the snapshot before

template <int Dim>
double normal_impulse(const Moment<Dim>& now) {
    double sum = 0.0;
    for (const solid::BodyImpulse<Dim>& pair : now.impulses) sum += pair.normal_impulse;
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
void Snapshots<Dim>::note(const Moment<Dim>& now) {
    const bool is_start = now.steps == 0, is_middle = now.steps == middle_step_;
    force_ = 0.0;
    if (is_start || ((in_contact_ || is_middle) && now.steps % every_ == 0)) {
        const double impulse = normal_impulse(now);
        if (!is_start) force_ = (impulse - last_impulse_) / (now.time - last_time_);
        last_impulse_ = impulse;
        last_time_ = now.time;
    }
    is_largest_ = force_ > (largest_ ? worth_another * largest_->force : 0.0);
    if (is_start || is_middle || is_largest_) wanted_step_ = now.steps;
}

template <int Dim>
void Snapshots<Dim>::see(const Sight<Dim>& sight) {
    const bool is_start = sight.moment.steps == 0;
    if (is_start) start_ = maker_->taken("At the start", sight);
    if (sight.moment.steps == middle_step_ && !is_start) middle_ = maker_->taken("In the middle", sight);
    if (!is_largest_) return;
    largest_ = maker_->taken("Near the largest contact force", sight);
    largest_->force = force_;
}

template <int Dim>
void Snapshots<Dim>::cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) {
    maker_->take_cells(solid.mesh(), first_cells);
}

template <int Dim>
void Snapshots<Dim>::end(const Sight<Dim>& sight) {
    end_ = maker_->taken("At the end", sight);
}

template <int Dim>
void Snapshots<Dim>::fail(const Sight<Dim>& sound) {
    end_ = maker_->taken("The last sound state", sound);
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
