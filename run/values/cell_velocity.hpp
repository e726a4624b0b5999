#pragma once
// Private to the layer.
#include <span>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/solid/cell_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {

/// v = M^-1 (p^- + p^+)/2 by cell [m/s].
template <int Dim>
[[nodiscard]] std::vector<Vector<Dim>> cell_velocity(std::span<const double> p_before, std::span<const double> p_after,
                                                     const solid::Solid<Dim>& solid) {
    std::vector<double> momentum(p_before.begin(), p_before.end());
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = 0.5 * (momentum[i] + p_after[i]);
    return solid.cells().velocity(momentum);
}

template <int Dim>
[[nodiscard]] std::vector<Vector<Dim>> cell_velocity(const dynamics::RunView<Dim>& run, const solid::Solid<Dim>& solid) {
    return cell_velocity<Dim>(run.p_before, run.p_after, solid);
}

}  // namespace abut::run
