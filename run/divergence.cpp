#include "abut/run/divergence.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "abut/base/error.hpp"
#include "abut/run/remedies.hpp"

namespace abut::run {
namespace {

/// H, less the work from outside, beyond this many times the energy in play: the solution is lost.
constexpr double divergence_factor = 1e3;

template <int Dim>
double own_energy(const dynamics::LedgerEntry<Dim>& entry) {
    return entry.energy - entry.received();
}

}  // namespace

template <int Dim>
bool is_alive(const dynamics::LedgerEntry<Dim>& entry, double scale, double excess_before) {
    if (!std::isfinite(entry.energy) || !std::isfinite(entry.pseudo_energy)) return false;
    return excess_before <= scale && (own_energy(entry) <= divergence_factor * scale || scale == 0.0);
}

template <int Dim>
void refuse_diverged(const Scene<Dim>& scene, const RunResult<Dim>& result, double scale, const WorstCell& worst) {
    const dynamics::LedgerEntry<Dim>& entry = result.ledger.entries().back();
    const std::string worst_is =
        fmt::format("Worst is {}, with {:.3g} m/s.", name_of_cell(scene.mesh, worst.cell), worst.speed);
    if (const double excess = result.ledger.energy_excess(); std::isfinite(entry.energy) && excess > scale)
        throw Diverged(
            fmt::format(
                "step {}, t = {:.4g} s: the run has diverged: H - H~ came to {:.3g} J, and the energy in play, {:.3g} "
                "J, is allowed: the motion swings from step to step and is no solution, though H~ stays. {} Steps are "
                "{:.4g} s long, stable are {:.4g} s. {}",
                entry.step, entry.time, excess, scale, worst_is, result.dt, result.stable.dt,
                result.dt > result.stable.dt ? "Lower --cfl or --dt."
                                             : "If bodies meet with edges or tips, blunt them or refine there; else take " +
                                                   calming_choices(result.options) + "."),
            {.cell = worst.cell, .value = excess, .allowed = scale});
    throw Diverged(
        fmt::format("step {}, t = {:.4g} s: the run has diverged: H is {:.3g} J, {:.3g} J of it work from outside, "
                    "and H~ {:.3g} J; {:g} times the energy in play, {:.3g} J, is allowed. {} Steps are {:.4g} s "
                    "long, stable are {:.4g} s: lower --cfl or --dt.",
                    entry.step, entry.time, entry.energy, entry.work, entry.pseudo_energy, divergence_factor, scale,
                    worst_is, result.dt, result.stable.dt),
        {.cell = worst.cell, .value = own_energy(entry), .allowed = divergence_factor * scale});
}

#define ABUT_INSTANTIATE(Dim)                                                       \
    template bool is_alive<Dim>(const dynamics::LedgerEntry<Dim>&, double, double); \
    template void refuse_diverged<Dim>(const Scene<Dim>&, const RunResult<Dim>&, double, const WorstCell&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
