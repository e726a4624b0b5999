#include "abut/run/steps/soundness.hpp"

#include <algorithm>

#include "abut/run/watch/divergence.hpp"

namespace abut::run {
namespace {

/// H - H~ up to this part of the energy in play: nothing is wrong yet.
constexpr double sound_share = 0.5;

}  // namespace

template <int Dim>
double Soundness<Dim>::scale() const {
    const RunResult<Dim>& result = start_.result;
    return std::max({result.energy.accounts.energy_in_play, result.energy.scale.value, result.energy.at_rest});
}

template <int Dim>
bool Soundness<Dim>::is_sound() const {
    const auto& entries = start_.result.ledger.entries();
    const dynamics::LedgerEntry<Dim>& last = entries.back();
    return entries.size() == 1 || last.energy - last.pseudo_energy <= sound_share * scale();
}

/// The record before the last one tells of H - H~, and at the end of the run the last one, too, unless all was at rest
/// until then.
template <int Dim>
bool Soundness<Dim>::is_alive(double excess_before) const {
    const RunResult<Dim>& result = start_.result;
    const auto& entries = result.ledger.entries();
    const bool at_end = entries.size() > 1 && entries.back().step == result.run.steps;
    const bool moved = result.energy.accounts.energy_in_play > result.energy.at_rest;
    return run::is_alive(entries.back(), scale(), at_end && moved ? result.ledger.energy_excess() : excess_before);
}

template <int Dim>
void Soundness<Dim>::refuse(const dynamics::IntegratorState& state) {
    if (!sound_.is_kept()) sound_.replace(state);
    const dynamics::IntegratorState sound = whole_.of(sound_.state()), lost = whole_.of(state);
    WorstCell worst;
    whole_.on_first([&] { worst = worst_cell<Dim>(lost, whole_.seen()); });
    tell({.sound = sound, .lost = &lost, .cells = {worst.cell}});
    whole_.on_first([&] { refuse_diverged(start_.present(), start_.result, scale(), worst); });
}

template <int Dim>
void Soundness<Dim>::tell_of_step(const Error& error) {
    const dynamics::IntegratorState sound = whole_.of(sound_.state());
    const solid::Solid<Dim>& solid = *start_.solid;
    tell({.sound = sound,
          .lost = nullptr,
          .cells = named_cells(error, solid.ranks(), whole_.seen(), solid.mesh().n_cells())});
}

template <int Dim>
void Soundness<Dim>::tell_of_crossing(const dynamics::IntegratorState& state) {
    tell({.sound = whole_.of(state), .lost = nullptr, .cells = {}});
}

/// The error of the run counts, not one of those who are told of it.
template <int Dim>
void Soundness<Dim>::tell(const Failure& failure) {
    whole_.on_first([&] {
        try {
            observer_.fail(failure, whole_.seen());
        } catch (...) {
        }
    });
}

template class Soundness<2>;
template class Soundness<3>;

}  // namespace abut::run
