#include "abut/run/watch/divergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/contact/contact.hpp"
#include "abut/run/values/gathered_cells.hpp"
#include "abut/run/watch/remedies.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::run {
namespace {

/// H~, less the work from outside, beyond this many times the energy in play: the solution is lost.
constexpr double divergence_factor = 1e3;
/// Part of H by which H~ may be off without meaning [-].
constexpr double rounding = 1e-10;

template <int Dim>
double own_energy(const dynamics::LedgerEntry<Dim>& entry) {
    return entry.pseudo_energy - entry.received();
}

}  // namespace

template <int Dim>
bool is_alive(const dynamics::LedgerEntry<Dim>& entry, double scale, double excess_before) {
    if (!std::isfinite(entry.energy) || !std::isfinite(entry.pseudo_energy)) return false;
    const double rounded = rounding * std::abs(entry.energy);  // H~ is a difference of energies as large as that
    return excess_before <= scale && own_energy(entry) <= divergence_factor * scale + rounded;
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
                entry.step, entry.time, excess, scale, worst_is, result.run.dt, result.run.stable.dt,
                result.run.dt > result.run.stable.dt
                    ? "Lower --cfl or --dt."
                    : "If bodies meet with edges or tips, blunt them or refine there; else take " +
                          calming_choices(result.options) + "."),
            {.cell = worst.cell, .value = excess, .allowed = scale});
    throw Diverged(
        fmt::format("step {}, t = {:.4g} s: the run has diverged: H is {:.3g} J, {:.3g} J of it work from outside, "
                    "and H~ {:.3g} J; {:g} times the energy in play, {:.3g} J, is allowed. {} Steps are {:.4g} s "
                    "long, stable are {:.4g} s: lower --cfl or --dt.",
                    entry.step, entry.time, entry.energy, entry.work, entry.pseudo_energy, divergence_factor, scale,
                    worst_is, result.run.dt, result.run.stable.dt),
        {.cell = worst.cell, .value = own_energy(entry), .allowed = divergence_factor * scale});
}

template <int Dim>
std::string advice_on_law(const Error& error, const solid::Solid<Dim>& solid) {
    constexpr double flat = 0.94;  // of 20 degrees
    const contact::Contact<Dim>* by_faces = solid.contact().reconstruction();
    const auto [face_1, face_2] = std::pair(error.facts().face_1, error.facts().face_2);
    if (error.kind() != ErrorKind::too_deep || !by_faces || face_1 < 0 || face_2 < 0) return "";
    const auto normal = [&](std::int64_t face) { return by_faces->surface().normal[static_cast<std::size_t>(face)]; };
    const double cosine = -normal(face_1).dot(normal(face_2));
    if (cosine > flat) return "";
    return fmt::format(
        " These faces are tilted by {:.0f} degrees against each other, and law = \"reconstruction\" reads their depth "
        "between their centres: take law = \"pair_potential\" (contact.law) first, which reads it where they overlap.",
        std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi);
}

template <int Dim>
std::vector<std::int32_t> named_cells(const Error& error, const solid::Solid<Dim>& solid, const mesh::Mesh<Dim>& whole) {
    ErrorFacts facts = error.facts();
    // A rank numbers cells and faces of its own; those of contact are the same on all.
    if (!solid.ranks().is_one()) {
        facts.cell = ErrorFacts::none;
        if (error.kind() != ErrorKind::too_deep) facts = {};
    }
    std::vector<std::int32_t> cells;
    if (facts.cell >= 0 && facts.cell < whole.n_cells()) cells.push_back(static_cast<std::int32_t>(facts.cell));
    const std::array here{solid.contact().boundary_of_face(facts.face_1), solid.contact().boundary_of_face(facts.face_2)};
    for (const solid::BoundaryFace face : GatheredCells<Dim>(solid, whole).faces(here))
        if (face != solid::no_face) cells.push_back(solid::cell_of(whole, face));
    return cells;
}

#define ABUT_INSTANTIATE(Dim)                                                                               \
    template bool is_alive<Dim>(const dynamics::LedgerEntry<Dim>&, double, double);                         \
    template void refuse_diverged<Dim>(const Scene<Dim>&, const RunResult<Dim>&, double, const WorstCell&); \
    template std::string advice_on_law<Dim>(const Error&, const solid::Solid<Dim>&);                        \
    template std::vector<std::int32_t> named_cells<Dim>(const Error&, const solid::Solid<Dim>&, const mesh::Mesh<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
