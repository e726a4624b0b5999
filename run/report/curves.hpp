#pragma once
// Private to the sources of run.
#include "abut/run/report/markup.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {

/// Pictures of a ledger: kinetic and potential energy, H and H~; their errors over the scale of energies, logarithmic.
template <int Dim>
[[nodiscard]] Markup energy_pictures(const RunResult<Dim>& result);
/// Pairs in contact over time; nothing where there were none.
template <int Dim>
[[nodiscard]] Markup contact_picture(const RunResult<Dim>& result);

}  // namespace abut::run
