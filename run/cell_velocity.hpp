#pragma once
// Private to the layer.
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {

/// v = M^-1 (p^- + p^+)/2 by cell [m/s].
template <int Dim>
[[nodiscard]] std::vector<Vector<Dim>> cell_velocity(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
    std::vector<double> momentum(run.p_before.begin(), run.p_before.end());
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = 0.5 * (momentum[i] + run.p_after[i]);
    return solid.cell_velocity(momentum);
}

}  // namespace abut::run
