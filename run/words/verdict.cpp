#include "abut/run/words/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <vector>

#include "abut/base/counted.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {
namespace {

/// |H~ - H~0 - W| over the scale above which more than rounding is at work [-].
constexpr double round_off = 1e-10;

/// The energy in play, and that of a motion which only the last step has begun [J].
template <int Dim>
double energy_at_end(const RunResult<Dim>& result) {
    const auto& entries = result.ledger.entries();
    return std::max(result.energy.accounts.energy_in_play, entries.empty() ? 0.0 : entries.back().kinetic);
}

template <int Dim>
bool rests(const RunResult<Dim>& result) {
    return energy_at_end(result) <= result.energy.at_rest;
}

/// Whether H~ drifts by more than rounding, whatever scale the user quotes figures on.
template <int Dim>
bool drifts(const RunResult<Dim>& result) {
    const double in_play = energy_at_end(result);
    const double scale = result.energy.scale.value > 0.0 ? std::min(result.energy.scale.value, in_play) : in_play;
    return result.ledger.pseudo_energy_drift() > std::max(round_off * scale, result.energy.at_rest);
}

template <int Dim>
std::string end_of(const RunResult<Dim>& result) {
    if (result.run.complete) return "The run came to its end.";
    return fmt::format("The run was asked to stop at t = {:.6g} s, before its end; all figures are those until then.",
                       result.ledger.entries().back().time);
}

template <int Dim>
std::string energy_of(const RunResult<Dim>& result, double drift, bool drifts, bool warns) {
    if (rests(result)) return "Nothing has moved.";
    if (const double in_play = energy_at_end(result); drifts && in_play < result.energy.scale.value)
        return fmt::format("The pseudo-energy drifts by {:.1e} of the energy in play: more than round-off.",
                           result.ledger.pseudo_energy_drift() / in_play);
    if (drifts)
        return fmt::format("The pseudo-energy drifts by {:.1e} of {}: more than round-off.", drift,
                           result.energy.scale.name);
    if (warns)
        return fmt::format("The pseudo-energy drifts by {:.1e} of {}, which does not see what the warnings say.", drift,
                           result.energy.scale.name);
    return fmt::format("The pseudo-energy is kept to round-off, {:.1e} of {}.", drift, result.energy.scale.name);
}

template <int Dim>
std::string contacts_of(const RunResult<Dim>& result, bool touched, bool warns) {
    if (const Encounter& nearest = result.watch.looks.nearest; !touched && !nearest.body_1.empty())
        return fmt::format(" Nothing touched: nearest at the end were {} and {}, {:.3g} m apart.", nearest.body_1,
                           nearest.body_2, nearest.distance);
    if (result.contact.report.missed_contacts > 0)
        return fmt::format(" {} missed: the energy is not exact.",
                           counted(result.contact.report.missed_contacts, "contact was", "contacts were"));
    return fmt::format(" {}{}.", counted(result.contact.report.events, "contact event"), warns ? "" : ", none missed");
}

}  // namespace

template <int Dim>
Verdict verdict(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    const double drift = result.energy.scale.over(result.ledger.pseudo_energy_drift());
    const std::size_t n_warnings = without_notes(all_warnings(scene, result)).size();
    const bool warns = n_warnings > 0, touched = result.contact.report.active_pairs_max > 0;
    const bool misses_all = !touched && !result.watch.looks.nearest.body_1.empty() && !rests(result);
    const bool sound = !warns && !drifts(result) && !misses_all;
    const std::string warned = warns   ? fmt::format(" {}.", counted(static_cast<std::int64_t>(n_warnings), "warning"))
                               : sound ? " Nothing warns."
                                       : "";
    return {.good = result.run.complete && sound,
            .text = end_of(result) + " " + energy_of(result, drift, drifts(result), warns) +
                    contacts_of(result, touched, warns) + warned};
}

template <int Dim>
std::vector<Warning> all_warnings(const Scene<Dim>& scene, const RunResult<Dim>& result) {
    std::vector<Warning> warnings = warnings_before(scene, result);
    std::ranges::copy(warnings_after(result), std::back_inserter(warnings));
    return warnings;
}

template <int Dim>
double momentum_drift(const RunResult<Dim>& result) {
    return result.energy.forces_from_outside.empty() || result.energy.accounts_for_outside
               ? result.energy.accounts.momentum_drift
               : std::numeric_limits<double>::quiet_NaN();
}

template <int Dim>
std::string momentum_note(const RunResult<Dim>& result) {
    const auto& outside = result.energy.forces_from_outside;
    if (outside.empty()) return "";
    return result.energy.accounts_for_outside ? fmt::format(", less what came from {}", fmt::join(outside, " and "))
                                              : fmt::format("not conserved: {}", fmt::join(outside, ", "));
}

template <int Dim>
std::string moment_note(const RunResult<Dim>& result) {
    const auto& outside = result.energy.moments_from_outside;
    return outside.empty() ? "" : fmt::format("not conserved: {}", fmt::join(outside, ", "));
}

#define ABUT_INSTANTIATE(Dim)                                                \
    template double momentum_drift<Dim>(const RunResult<Dim>&);              \
    template std::string momentum_note<Dim>(const RunResult<Dim>&);          \
    template std::string moment_note<Dim>(const RunResult<Dim>&);            \
    template Verdict verdict<Dim>(const Scene<Dim>&, const RunResult<Dim>&); \
    template std::vector<Warning> all_warnings<Dim>(const Scene<Dim>&, const RunResult<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
