#pragma once
// Private to the layer.
#include <cstdint>
#include <string>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/ranks.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/values/failure.hpp"

namespace abut::run {

/// True if a run has not diverged, after its last record: energies are finite, H~ less the work from outside is at most
/// 1,000 times `scale` [J], and H - H~ of the records before is at most `scale` itself, whatever H~ says. That of the
/// last record is left out: where all was at rest until now, what a force is about to do is in H - H~ before it is in
/// any other energy. `excess_before`: Ledger::energy_excess without the last record [J].
template <int Dim>
[[nodiscard]] bool is_alive(const dynamics::LedgerEntry<Dim>& entry, double scale, double excess_before);

/// Throws Diverged with the figures of the last entry of the ledger.
template <int Dim>
[[noreturn]] void refuse_diverged(const Scene<Dim>& scene, const RunResult<Dim>& result, double scale,
                                  const WorstCell& worst);

/// Advice for a user about the error of a step: the modified reconstruction reads the depth of tilted faces between their
/// centroids, and there the other law is the cure.
template <int Dim>
[[nodiscard]] std::string advice_on_law(const Error& error, const solid::Solid<Dim>& solid);

/// The cells of the whole mesh that the error of a step names, on rank 0. A call of all ranks; `whole` is looked at on rank
/// 0 alone.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> named_cells(const Error& error, const solid::Solid<Dim>& solid,
                                                    const mesh::Mesh<Dim>& whole);

}  // namespace abut::run
