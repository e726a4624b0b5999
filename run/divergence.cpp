#include "abut/run/divergence.hpp"

#include <fmt/format.h>

#include <cmath>

#include "abut/base/error.hpp"

namespace abut::run {
namespace {

/// H beyond this many times its first value: the solution is lost.
constexpr double divergence_factor = 1e3;

}  // namespace

template <int Dim>
bool is_alive(const dynamics::LedgerEntry<Dim>& entry, double scale) {
    return std::isfinite(entry.pseudo_energy) && entry.energy <= divergence_factor * scale;
}

template <int Dim>
void refuse_diverged(const Scene<Dim>& scene, const RunResult<Dim>& result, double scale, const WorstCell& worst) {
    const dynamics::LedgerEntry<Dim>& entry = result.ledger.entries().back();
    throw Diverged(fmt::format("step {}, t = {:.4g} s: the run has diverged: H is {:.3g} J and H~ {:.3g} J; {:g} times "
                               "{:.3g} J is allowed. Worst is {}, with {:.3g} m/s. Steps are {:.4g} s long, stable are "
                               "{:.4g} s: lower --cfl or --dt.",
                               entry.step, entry.time, entry.energy, entry.pseudo_energy, divergence_factor, scale,
                               name_of_cell(scene.mesh, worst.cell), worst.speed, result.dt, result.stable.dt),
                   {.cell = worst.cell, .value = entry.energy, .allowed = divergence_factor * scale});
}

#define ABUT_INSTANTIATE(Dim)                                               \
    template bool is_alive<Dim>(const dynamics::LedgerEntry<Dim>&, double); \
    template void refuse_diverged<Dim>(const Scene<Dim>&, const RunResult<Dim>&, double, const WorstCell&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
