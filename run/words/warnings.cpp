#include "abut/run/words/warnings.hpp"
#include "abut/base/counted.hpp"
#include "abut/run/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "abut/run/watch/fine_motion.hpp"
#include "abut/run/watch/friction_watch.hpp"
#include "abut/run/watch/remedies.hpp"
#include "abut/run/watch/returned_flow.hpp"
#include "abut/run/watch/thresholds.hpp"
#include "abut/run/words/bond_text.hpp"
#include "abut/run/words/counts.hpp"
#include "abut/run/words/erosion_text.hpp"
#include "abut/solid/kinematics/kinematics.hpp"
#include "abut/solid/kinematics/properties.hpp"

namespace abut::run {
namespace {

constexpr double kinetic_of_rest = 1e-9;  // of the energy in play: bodies with no more are at rest, or came to it

/// Warns of what was seen at records: bodies past the rim of their floor, and bodies that came near themselves.
template <int Dim>
void add_sightings(Counts& counts, const RunResult<Dim>& result) {
    for (const PastRim& past : result.watch.sightings.past_rims)
        counts.warnings.push_back(
            {WarningKind::past_rim, Severity::warning,
             fmt::format("by t = {:.4g} s body '{}' is past the rim of obstacle '{}', and nothing is below it there. A "
                         "plane without half_width has no end",
                         past.time, past.body, past.obstacle),
             past.time, 0.0});
    for (const NearItself<Dim>& near : result.watch.sightings.near_themselves)
        counts.warnings.push_back(
            {WarningKind::near_itself, Severity::warning,
             fmt::format(
                 "by t = {:.4g} s body '{}' has come together with itself at ({:.4g}): two parts of its surface, "
                 "{:.3g} m apart at rest, have a gap of {:.3g} m, and no contact acts within a body. contact.self = true "
                 "lets it act",
                 near.time, near.body, fmt::join(near.position, ", "), near.gap_at_rest, near.gap),
             near.gap, 0.0});
    for (const LookEnded& ended : result.watch.sightings.looks_ended)
        counts.warnings.push_back(
            {WarningKind::look_ended, Severity::warning,
             fmt::format("from t = {:.4g} s on nobody looks whether body '{}' comes together with itself: {}", ended.time,
                         ended.body, ended.reason),
             ended.time, 0.0});
}

/// Warns of what H~ does not see.
template <int Dim>
void add_motion(Counts& counts, const RunResult<Dim>& result) {
    const dynamics::Ledger<Dim>& ledger = result.ledger;
    const auto add_above = [&](WarningKind kind, double value, double threshold, std::string text) {
        if (value > threshold) counts.warnings.push_back({kind, Severity::warning, std::move(text), value, threshold});
    };
    const bool is_memm =
        result.options.integrator == SolidIntegrator::memm || result.options.integrator == SolidIntegrator::memm_async;
    // A scale that the user gives is one to quote figures on, and may be any.
    const double energy =
        result.energy.accounts.energy_in_play > result.energy.at_rest ? result.energy.accounts.energy_in_play : 0.0;
    if (is_memm && energy > 0.0) {
        const double excess = (ledger.energy_excess() - result.energy.at_rest) / energy;
        add_above(WarningKind::energy_excess, excess, large_energy_excess,
                  fmt::format("H - H~ came to {:.2g} of the energy in play, {:g} is safe: so much swings from step to step, "
                              "unseen by H~. Where contact excites it take {}; tips and edges that meet are to be blunted",
                              excess, large_energy_excess, calming_choices(result.options)));
    }
    const auto kinetic = [](const auto& entry) { return entry.kinetic; };
    const auto& entries = ledger.entries();
    const bool rests = std::ranges::all_of(
        entries, [&](double value) { return value <= std::max(kinetic_of_rest * energy, result.energy.at_rest); }, kinetic);
    if (is_memm && result.energy.accounts.speed > 0.0 && (entries.empty() || !rests)) {
        const double share = ledger.parasitic() / result.energy.accounts.speed;
        add_above(WarningKind::parasitic, share, large_parasitic_share,
                  fmt::format("a cell swings from step to step by |e|/m = {:.2g} m/s, {:.2g} of the largest speed, {:g} is "
                              "safe: do not read single cells near contact, or take {}",
                              ledger.parasitic(), share, large_parasitic_share, calming_choices(result.options)));
    }
    if (energy > 0.0) {
        const double share = result.energy.fine_max / energy;
        add_above(WarningKind::fine_motion, share, large_fine_share,
                  fmt::format("motion from cell to cell came to {:.2g} of the energy in play, {:g} is safe, and neither H~ "
                              "nor H - H~ sees it: the upper half of the modes is pumped, or waves are shorter than cells "
                              "resolve. Take a shorter step (cfl), smaller cells, or damp it (stiffness_damping)",
                              share, large_fine_share));
    }
    if (result.energy.moment_scale > 0.0 && energy > 0.0) {
        const double drift = ledger.pseudo_angular_momentum_drift() / (result.energy.moment_scale * std::sqrt(energy));
        add_above(
            WarningKind::moment_drift, drift, large_moment_drift,
            fmt::format("J~ changes by {:.2g} kg m^2/s, {:.2g} of what it may be with this energy, {:g} is safe, though "
                        "nothing acts from outside: forces of contact have a moment",
                        ledger.pseudo_angular_momentum_drift(), drift, large_moment_drift));
    }
}

/// Warns of bodies that glide on less friction than they have.
template <int Dim>
void add_weak_friction(Counts& counts, const RunResult<Dim>& result) {
    const WeakFriction& weak = result.watch.weak_friction;
    const double time = result.ledger.entries().empty() ? 0.0 : result.ledger.entries().back().time;
    if (!(weak.seconds > weak_friction_time * time)) return;
    const char* const remedy =
        result.options.settle
            ? "Damp them (stiffness_damping of the body)"
            : "Weight or load that comes at once sets them off: begin at rest under it (run.settle = true), and damp "
              "them (stiffness_damping of the body)";
    counts.warnings.push_back(
        {WarningKind::weak_friction, Severity::warning,
         fmt::format("{} and {} slid past each other for {:.2g} s with {:.2g} of the friction of their normal force, {:g} "
                     "is safe: faces "
                     "that vibrate stick and slide in turn, so that a body glides too far, or where it should stick. {}",
                     weak.body_1, weak.body_2, weak.seconds, weak.share, FrictionWatch<Dim>::enough_friction, remedy),
         weak.seconds, weak_friction_time * time});
}

/// Warns of what is seen of the surfaces, whatever contact knows.
template <int Dim>
void add_looks(Counts& counts, const RunResult<Dim>& result) {
    const SurfaceLooks& looks = result.watch.looks;
    const auto add_above = [&](WarningKind kind, const Encounter& met, double threshold, const auto& text) {
        if (met.ratio > threshold) counts.warnings.push_back({kind, Severity::warning, text(met), met.ratio, threshold});
    };
    const std::string looked = fmt::format("; looked at {} times", looks.looks);
    add_above(WarningKind::interpenetration, looks.deepest, deep_interpenetration, [&](const Encounter& met) {
        return fmt::format(
            "{} and {} are inside each other at t = {:.4g} s: two of their cells by {:.2g} m, {:.2g} of the "
            "size of the smaller one, {:g} is safe{}. Contact has not seen it, or gave way: look at tips and "
            "edges, at surfaces that look inwards, and at the speed",
            met.body_1, met.body_2, met.time, met.distance, met.ratio, deep_interpenetration, looked);
    });
    add_above(WarningKind::remote_contact, looks.remote, contact_from_afar, [&](const Encounter& met) {
        return fmt::format(
            "faces of {} and {} push each other at t = {:.4g} s and are {:.2g} m apart, {:.2g} of the size of "
            "the smaller one, {:g} is safe{}. Make faces that meet more equal in size{}",
            met.body_1, met.body_2, met.time, met.distance, met.ratio, contact_from_afar, looked,
            result.options.law == solid::ContactLaw::reconstruction ? ", or take --law pair_potential" : "");
    });
    add_above(WarningKind::sliding_pressure, looks.pressed, high_sliding_pressure, [&](const Encounter& met) {
        return fmt::format(
            "{} and {} slide along each other at t = {:.4g} s under a mean pressure of {:.2g} E of the softer "
            "one, {:g} is safe{}: where faces do not lie in one plane, sliding may cost more than 1 % of "
            "its speed. Finer faces or a lower pressure make it less",
            met.body_1, met.body_2, met.time, met.ratio, high_sliding_pressure, looked);
    });
    if (looks.pressed.ratio > high_sliding_pressure) counts.warnings.back().severity = Severity::note;
    if (!looks.nearest.body_1.empty())
        counts.warnings.push_back({WarningKind::nothing_touched, Severity::note,
                                   fmt::format("nothing touched: nearest at the end were {} and {}, {:.4g} m apart",
                                               looks.nearest.body_1, looks.nearest.body_2, looks.nearest.distance),
                                   looks.nearest.distance, 0.0});
}

void warn(Counts& counts, WarningKind kind, double value, double threshold, std::string text) {
    counts.warnings.push_back({kind, Severity::warning, std::move(text), value, threshold});
}

template <int Dim>
void add_compression(Counts& counts, const RunResult<Dim>& result) {
    if (const Compressed& pressed = result.watch.compressed; pressed.steps > 0)
        warn(counts, WarningKind::compression, pressed.compression, result.options.contact.compression_warning,
             fmt::format("{} and {} are strongly compressed in {} of {:.0f} steps, at most {:.2g} of D, the depth of their "
                         "cells, {:g} is safe. A lower speed or load makes it less, "
                         "a stiffer material too",
                         pressed.body_1, pressed.body_2, pressed.steps,
                         static_cast<double>(result.run.steps) * result.run.dt / result.run.finest_dt, pressed.compression,
                         result.options.contact.compression_warning));
}

/// Warnings of faces that slide: too stiff, too deep, or with too little friction.
template <int Dim>
void add_slip(Counts& counts, const RunResult<Dim>& result) {
    const contact::ContactReport& contact = result.contact.report;
    if (contact.sliding_ratio_max > stiff_sliding_ratio)
        warn(counts, WarningKind::stiff_sliding, contact.sliding_ratio_max, stiff_sliding_ratio,
             fmt::format("faces are pressed into each other deeper than they are wide ({:.2g} of the width where they slide "
                         "off each other, {:g} is safe): contact is stiffer than the stable step allows for. Look at H - H~ "
                         "and |e|/m; a lower --cfl, --filter neutral, or faces as wide as their cells are deep make it "
                         "better",
                         contact.sliding_ratio_max, stiff_sliding_ratio));
    if (contact.slipped_compression_max > deep_slip_compression)
        warn(
            counts, WarningKind::deep_slip, contact.slipped_compression_max, deep_slip_compression,
            fmt::format("{} slid off each other while pressed in, by up to {:.2g} of D, the depth of their "
                        "cells. At a free edge that is as it should be; elsewhere bodies pass through each other. A lower "
                        "speed prevents it, and so does --overlap frozen, under which H~ drifts",
                        counted(contact.slipped_pairs, "pair of faces", "pairs of faces"), contact.slipped_compression_max));
    if (const double share = result.contact.sliding.least_share(); share < least_sliding_share)
        warn(counts, WarningKind::alternating_slip, share, least_sliding_share,
             fmt::format(
                 "faces that slide feel {:.2g} of the friction that they should for a part of the run, {:g} is safe: their "
                 "slip alternates from "
                 "step to step, and dissipation is wrong though the balance of energy holds. Leave --restart out (10 and "
                 "the filter act with friction), or take a lower --cfl",
                 share, least_sliding_share));
}

template <int Dim>
void add_turns(Counts& counts, const RunResult<Dim>& result) {
    if (const auto& [name, rotation] = result.watch.turned; rotation > far_rotation)
        warn(counts, WarningKind::rotation, rotation, far_rotation,
             fmt::format("{} has turned by {:.2g} rad, {:g} is safe. A body of kinematics \"small\" grows as it turns, by "
                         "{:.2g} % at this angle, and no energy shows it. kinematics = \"floating\" lets it turn",
                         name, rotation, far_rotation, 100.0 * (1.0 / std::cos(rotation) - 1.0)));
    double local_rotation = 0.0;
    for (std::size_t body = 0; body < result.bodies.local_rotations.size(); ++body)
        if (result.bodies.all_may_turn || (body < result.bodies.may_turn.size() && result.bodies.may_turn[body]))
            local_rotation = std::max(local_rotation, result.bodies.local_rotations[body]);
    if (local_rotation > far_rotation)
        warn(
            counts, WarningKind::local_rotation, local_rotation, far_rotation,
            fmt::format("a cell has turned by {:.2g} rad against the frame of its body, {:g} is safe. Strains are linear in "
                        "that frame. Parts that turn against each other are to be bodies of their own, joined by springs",
                        local_rotation, far_rotation));
}

/// Warnings of finite bodies whose law is not made for their strains.
template <int Dim>
void add_strains(Counts& counts, const RunResult<Dim>& result) {
    if (result.bodies.finite.strain > large_strain)
        warn(counts, WarningKind::finite_strain, result.bodies.finite.strain, large_strain,
             fmt::format(
                 "a cell of a finite body was strained by {:.2g}, {:g} is safe, and the least det F was {:.2g}: St. "
                 "Venant and Kirchhoff's material is one of small strains, and weak in compression. Look at H - H~: "
                 "if noise grows, take {}; behind a shock linear_viscosity = 0.25 with quadratic_viscosity = 2 damps it",
                 result.bodies.finite.strain, large_strain, result.bodies.finite.determinant,
                 calming_choices(result.options)));
    if (result.bodies.finite_kinematic_hardening && result.bodies.finite.plastic_strain > large_kinematic_flow)
        warn(counts, WarningKind::kinematic_flow, result.bodies.finite.plastic_strain, large_kinematic_flow,
             fmt::format(
                 "a cell has a plastic strain of {:.2g}, {:g} is safe with kinematic_hardening in a finite body: where "
                 "axes of strain turn, as in shear, its stress is too low (3 % at 0.6, 20 % at 1.2), and no energy "
                 "shows it. Metal that has flowed to and fro in small strains is right; metal that flows so far in one "
                 "direction should have hardening in place of kinematic_hardening",
                 result.bodies.finite.plastic_strain, large_kinematic_flow));
}

/// Warnings of plastic flow that is lost where it should not be.
template <int Dim>
void add_plastic_losses(Counts& counts, const RunResult<Dim>& result) {
    const dynamics::Losses& loss = result.energy.dissipated;
    if (const double share = std::abs(loss.on_faces) / loss.in_cells; share > large_face_loss)
        warn(counts, WarningKind::face_loss, share, large_face_loss,
             fmt::format(
                 "free faces that flow along with their cells take {:.2g} of what plastic flow dissipates out of contact "
                 "and of jumps between cells, {:g} is safe: cells at the surface are too large for what happens "
                 "there, though the balance of energy holds. Finite metal that is pressed far beyond yield bears 5 % "
                 "too much at 0.06, and 7 % at 0.12. Take smaller cells, or kinematics \"floating\" where nothing bends "
                 "far",
                 share, large_face_loss));
    if (const ReturnedFlow returned = returned_flow(result.ledger); returned.share > large_returned_flow)
        warn(counts, WarningKind::returned_flow, returned.share, large_returned_flow,
             fmt::format(
                 "plastic flow gave energy back in {}, {:.2g} of what it dissipates, {:g} is safe: faces that contact "
                 "pushes flow along with cells that are too large, though the balance of energy holds. Take smaller "
                 "cells, or a lower speed",
                 counted(returned.records, "record"), returned.share, large_returned_flow));
    if (const double share = loss.in_jumps / (loss.in_cells + loss.in_jumps); share > large_jump_loss)
        warn(counts, WarningKind::jump_loss, share, large_jump_loss,
             fmt::format("jumps between cells dissipate {:.2g} of what plastic flow does in all, {:g} is safe: they yield "
                         "where cells "
                         "may be elastic, though the balance of energy holds. Take smaller cells, or a larger jump_cap",
                         share, large_jump_loss));
}

/// Warnings of cells that left, and of fragments that came apart.
template <int Dim>
void add_lost_parts(Counts& counts, const RunResult<Dim>& result) {
    if (const ErodedShares shares = eroded_shares(result); shares.larger() > large_eroded_share)
        warn(
            counts, WarningKind::erosion, shares.larger(), large_eroded_share,
            fmt::format("cells that left took {:.2g} of the mass and {:.2g} of the energy in play along, {:g} is safe: what "
                        "is left depends on the size of cells there. Take smaller cells where they leave, or a higher limit "
                        "(erosion)",
                        shares.mass, shares.energy, large_eroded_share));
    if (const double at_splits = std::abs(result.energy.dissipated.at_splits),
        share = at_splits / result.energy.accounts.energy_in_play;
        share > large_split_share)
        warn(counts, WarningKind::splits, share, large_split_share,
             fmt::format(
                 "fragments that came apart, turned against each other or broke under pressure changed V by "
                 "{:.2g} of the energy in play, {:g} is safe: strains are linear in the frame that each takes. Take larger "
                 "grains, or finite kinematics",
                 share, large_split_share));
    if (const double error = fracture_error(result.energy.dissipated.in_bonds, result.bonds.beyond_fracture_energy);
        error > large_fracture_error)
        warn(counts, WarningKind::fracture_energy, error, large_fracture_error,
             fmt::format(
                 "bonds that opened dissipated {} than their fracture energy by {:.2g} of it, {:g} is safe, though the "
                 "balance of energy holds: they opened within few steps, or cells hold energy of several faces together. "
                 "Take smaller cells where bonds.cohesive_length is a few of them, or a smaller step",
                 result.bonds.beyond_fracture_energy > 0.0 ? "more" : "less", error, large_fracture_error));
}

template <int Dim>
void add_contacts(Counts& counts, const RunResult<Dim>& result) {
    const contact::ContactReport& contact = result.contact.report;
    counts.add(WarningKind::missed_contacts, Severity::warning, contact.missed_contacts,
               fmt::format("{} missed, 0 are allowed: the energy is not exact",
                           counted(contact.missed_contacts, "contact was", "contacts were")));
    counts.add(
        WarningKind::inadmissible_overlaps, Severity::note, result.contact.inadmissible_overlaps_max,
        fmt::format("up to {} without being contacts: far sides of bodies",
                    counted(result.contact.inadmissible_overlaps_max, "pair of faces overlaps", "pairs of faces overlap")));
}

}  // namespace

template <int Dim>
std::vector<Warning> warnings_during(std::int64_t step, const RunResult<Dim>& result) {
    const contact::ContactOptions& options = result.options.contact;
    Counts counts;
    add_sightings(counts, result);
    if (const Compressed& pressed = result.watch.compressed; pressed.steps > 0)
        counts.warnings.push_back(
            {WarningKind::compression, Severity::warning,
             fmt::format("by step {} faces of {} and {} are pressed {:.2g} of D, the depth of their cells, into each other, "
                         "more than {:g}; above {:g} the run stops. A lower speed or load makes it less",
                         step, pressed.body_1, pressed.body_2, pressed.compression, options.compression_warning,
                         options.compression_limit),
             pressed.compression, options.compression_warning});
    return std::move(counts.warnings);
}

template <int Dim>
std::vector<Warning> warnings_after(const RunResult<Dim>& result) {
    Counts counts;
    add_motion(counts, result);
    add_looks(counts, result);
    add_compression(counts, result);
    add_slip(counts, result);
    add_turns(counts, result);
    add_weak_friction(counts, result);
    add_strains(counts, result);
    add_plastic_losses(counts, result);
    add_lost_parts(counts, result);
    add_sightings(counts, result);
    add_contacts(counts, result);
    return in_user_words(std::move(counts.warnings));
}

std::vector<Warning> without_notes(std::vector<Warning> warnings) {
    std::erase_if(warnings, [](const Warning& warning) { return warning.severity == Severity::note; });
    return warnings;
}

#define ABUT_INSTANTIATE(Dim)                                                                \
    template std::vector<Warning> warnings_during<Dim>(std::int64_t, const RunResult<Dim>&); \
    template std::vector<Warning> warnings_after<Dim>(const RunResult<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
