#include "abut/run/steps/soundness.hpp"

#include <algorithm>
#include <cstdint>
#include <exception>

#include "abut/run/values/cell_velocity.hpp"
#include "abut/run/values/gathered_cells.hpp"
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
auto Soundness<Dim>::motions_in(const dynamics::IntegratorState& own) const -> CellMotions {
    const solid::Solid<Dim>& solid = *start_.solid;
    const GatheredCells<Dim> gathered(solid, start_.present().mesh);
    const auto brought = [&](const std::vector<Vector<Dim>>& of_part) {
        return gathered.template cells<Vector<Dim>>([&](std::int32_t c) { return of_part[static_cast<std::size_t>(c)]; });
    };
    return {brought(solid.cells().displacement(own.q)), brought(cell_velocity<Dim>(own.p_before, own.p_after, solid))};
}

template <int Dim>
void Soundness<Dim>::refuse(const dynamics::IntegratorState& state) {
    if (!sound_.is_kept()) sound_.replace(state);
    const dynamics::IntegratorState lost = whole_.of(state), sound = whole_.of(sound_.state());
    const CellMotions motions = motions_in(state);
    Failure failure{.sound = sound, .lost = &lost};
    for (const Vector<Dim>& velocity : motions.velocity) failure.lost_speed.push_back(velocity.norm());
    WorstCell worst;
    whole_.on_first([&] {
        worst = worst_cell<Dim>(motions.displacement, motions.velocity);
        failure.cells = {worst.cell};
    });
    tell(sound_.state(), std::move(failure));
    whole_.on_first([&] { refuse_diverged(start_.present(), start_.result, scale(), worst); });
}

template <int Dim>
void Soundness<Dim>::tell_of_step(const Error& error) {
    const dynamics::IntegratorState sound = whole_.of(sound_.state());
    tell(sound_.state(), {.sound = sound, .cells = named_cells(error, *start_.solid, start_.present().mesh)});
}

template <int Dim>
void Soundness<Dim>::tell_of_crossing(const dynamics::IntegratorState& state) {
    const dynamics::IntegratorState sound = whole_.of(state);
    tell(state, {.sound = sound});
}

/// The error of the run counts, not one of those who are told of it. Contact was last searched where the run was lost.
template <int Dim>
void Soundness<Dim>::tell(const dynamics::IntegratorState& own_sound, Failure failure) {
    solid::Solid<Dim>& solid = *start_.solid;
    const mesh::Mesh<Dim>& whole = start_.present().mesh;
    Sight<Dim> sight;
    try {
        solid.restore(solid.state(), own_sound.q);
        sight = sight_of<Dim>(dynamics::RunView<Dim>(own_sound), solid, whole);
    } catch (const std::exception& error) {
        failure.not_evaluated = error.what();
        CellMotions motions = motions_in(own_sound);
        sight.moment = {.steps = own_sound.steps, .time = own_sound.time};
        sight.mesh = &whole;
        sight.options = &solid.options();
        sight.any_turns = solid.moment_arms() == dynamics::MomentArms::mid_step;
        sight.displacement = std::move(motions.displacement);
        sight.velocity = std::move(motions.velocity);
    }
    whole_.on_first([&] {
        try {
            observer_.fail(failure, sight);
        } catch (...) {
        }
    });
}

template class Soundness<2>;
template class Soundness<3>;

}  // namespace abut::run
