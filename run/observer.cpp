#include "abut/run/observer.hpp"

#include <algorithm>

#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/checkpoint.hpp"
#include "abut/run/values/failure.hpp"
#include "abut/run/values/frame_piece.hpp"
#include "abut/run/values/sight.hpp"

namespace abut::run {

template <int Dim>
void Observers<Dim>::settling(std::int64_t step, double speed) {
    for (Observer<Dim>& observer : observers_) observer.settling(step, speed);
}

template <int Dim>
void Observers<Dim>::begin(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    for (Observer<Dim>& observer : observers_) observer.begin(scene, result);
}

template <int Dim>
void Observers<Dim>::record(const dynamics::LedgerEntry<Dim>& entry, const RunResult<Dim>& result) {
    for (Observer<Dim>& observer : observers_) observer.record(entry, result);
}

template <int Dim>
void Observers<Dim>::note(const Moment<Dim>& moment) {
    for (Observer<Dim>& observer : observers_) observer.note(moment);
}

template <int Dim>
bool Observers<Dim>::wants_sight(std::int64_t step) const {
    return std::ranges::any_of(observers_, [&](const Observer<Dim>& observer) { return observer.wants_sight(step); });
}

template <int Dim>
void Observers<Dim>::see(const Sight<Dim>& sight) {
    for (Observer<Dim>& observer : observers_)
        if (observer.wants_sight(sight.moment.steps)) observer.see(sight);
}

template <int Dim>
void Observers<Dim>::see_at_time(const Sight<Dim>& sight) {
    for (Observer<Dim>& observer : observers_) observer.see_at_time(sight);
}

template <int Dim>
void Observers<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    for (Observer<Dim>& observer : observers_) observer.look(run, solid);
}

template <int Dim>
void Observers<Dim>::look_at_time(const dynamics::RunView<Dim>& run, solid::Solid<Dim>& solid) {
    for (Observer<Dim>& observer : observers_) observer.look_at_time(run, solid);
}

template <int Dim>
bool Observers<Dim>::wants_look(std::int64_t step) const {
    return std::ranges::any_of(observers_, [&](const Observer<Dim>& observer) { return observer.wants_look(step); });
}

template <int Dim>
void Observers<Dim>::cells_left(const solid::Solid<Dim>& solid, std::span<const std::int32_t> first_cells) {
    for (Observer<Dim>& observer : observers_) observer.cells_left(solid, first_cells);
}

template <int Dim>
void Observers<Dim>::end(const Sight<Dim>& sight) {
    for (Observer<Dim>& observer : observers_) observer.end(sight);
}

template <int Dim>
void Observers<Dim>::progress(std::int64_t step, double time) {
    for (Observer<Dim>& observer : observers_) observer.progress(step, time);
}

template <int Dim>
bool Observers<Dim>::asks_to_stop() const {
    return std::ranges::any_of(observers_, [](const Observer<Dim>& observer) { return observer.asks_to_stop(); });
}

template <int Dim>
void Observers<Dim>::fail(const Failure& failure, const Sight<Dim>& sound) {
    for (Observer<Dim>& observer : observers_) {
        try {
            observer.fail(failure, sound);
        } catch (...) {  // the others are told all the same, and what the run throws follows
        }
    }
}

template <int Dim>
std::int64_t Observers<Dim>::wants_piece(std::int64_t step) const {
    std::int64_t wanted = -1;
    for (const Observer<Dim>& observer : observers_) wanted = std::max(wanted, observer.wants_piece(step));
    return wanted;
}

template <int Dim>
void Observers<Dim>::piece(const FramePiece<Dim>& piece) {
    for (Observer<Dim>& observer : observers_) observer.piece(piece);
}

template <int Dim>
void Observers<Dim>::all_pieces(const FramePiece<Dim>& piece) {
    for (Observer<Dim>& observer : observers_) observer.all_pieces(piece);
}

template <int Dim>
bool Observers<Dim>::wants_checkpoint(std::int64_t step, bool stops) const {
    return std::ranges::any_of(observers_,
                               [&](const Observer<Dim>& observer) { return observer.wants_checkpoint(step, stops); });
}

template <int Dim>
void Observers<Dim>::keep(const Checkpoint& checkpoint) {
    for (Observer<Dim>& observer : observers_) observer.keep(checkpoint);
}

template <int Dim>
void Observers<Dim>::save(StateWriter& state) {
    for (Observer<Dim>& observer : observers_) observer.save(state);
}

template <int Dim>
void Observers<Dim>::resume(const Scene<Dim>& scene, const RunResult<Dim>& result, StateReader& state) {
    for (Observer<Dim>& observer : observers_) observer.resume(scene, result, state);
}

template class Observers<2>;
template class Observers<3>;

}  // namespace abut::run
