#pragma once
// Private to the sources of run.
#include <array>
#include <span>

#include "abut/dynamics/ledger.hpp"
#include "abut/run/drawing/markup.hpp"
#include "abut/run/drawing/plot.hpp"
#include "abut/run/result.hpp"

namespace abut::run {

/// Kinetic and potential energy, H and H~ over time; their errors over the scale of energies, logarithmic.
template <int Dim>
[[nodiscard]] std::array<Plot, 2> energy_plots(std::span<const dynamics::LedgerEntry<Dim>> entries,
                                               const EnergyScale& scale);

/// These of a report.
template <int Dim>
[[nodiscard]] Markup energy_pictures(const RunResult<Dim>& result);
/// Pairs in contact over time; nothing where there were none.
template <int Dim>
[[nodiscard]] Markup contact_picture(const RunResult<Dim>& result);

}  // namespace abut::run
