#pragma once
// Private to the layer.
#include "abut/dynamics/ledger.hpp"
#include "abut/run/failure.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {

/// Whether a run has not diverged: energies are finite and H is at most 1,000 times `scale` [J], whatever H~ says.
template <int Dim>
[[nodiscard]] bool is_alive(const dynamics::LedgerEntry<Dim>& entry, double scale);

/// Throws Diverged with the figures of the last entry of the ledger.
template <int Dim>
[[noreturn]] void refuse_diverged(const Scene<Dim>& scene, const RunResult<Dim>& result, double scale,
                                  const WorstCell& worst);

}  // namespace abut::run
