#include "abut/run/report/curves.hpp"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace abut::run {
namespace {

template <int Dim>
using Entries = std::span<const dynamics::LedgerEntry<Dim>>;

template <int Dim>
using Quantity = std::function<double(const dynamics::LedgerEntry<Dim>&)>;

template <int Dim>
std::vector<double> values(Entries<Dim> entries, const Quantity<Dim>& quantity) {
    std::vector<double> all;
    for (const auto& entry : entries) all.push_back(quantity(entry));
    return all;
}

template <int Dim>
std::vector<double> times(Entries<Dim> entries) {
    return values<Dim>(entries, [](const auto& entry) { return entry.time; });
}

Markup figure(const Plot& plot, const std::string& caption) {
    return element("figure", drawing(plot) + element("figcaption", caption)) + "\n";
}

template <int Dim>
Plot energies(Entries<Dim> entries) {
    return {.title = "Energies over time",
            .x_label = "time [s]",
            .y_label = "energy [J]",
            .x = times<Dim>(entries),
            .curves = {{"H", "grey", values<Dim>(entries, [](const auto& entry) { return entry.energy; })},
                       {"kinetic", "blue", values<Dim>(entries, [](const auto& entry) { return entry.kinetic; })},
                       {"potential", "orange", values<Dim>(entries, [](const auto& entry) { return entry.potential; })},
                       {"H~", "ink", values<Dim>(entries, [](const auto& entry) { return entry.pseudo_energy; })}}};
}

/// |H~ - H~0 - W|, less what restarts with another step have added, and H - H~.
template <int Dim>
Plot errors(Entries<Dim> entries, const EnergyScale& scale) {
    const double start = entries.front().pseudo_energy;
    const auto drift = [=, &scale](const auto& entry) {
        return scale.over(std::abs(entry.pseudo_energy - start - entry.received()));
    };
    const auto excess = [&scale](const auto& entry) { return scale.over(entry.energy - entry.pseudo_energy); };
    return {.title = "Errors of the energies over time",
            .x_label = "time [s]",
            .y_label = "over " + scale.name,
            .x = times<Dim>(entries),
            .curves = {{"H - H~", "orange", values<Dim>(entries, excess)},
                       {"|H~ - H~0 - W|", "ink", values<Dim>(entries, drift)}},
            .logarithmic = true};
}

}  // namespace

template <int Dim>
std::array<Plot, 2> energy_plots(std::span<const dynamics::LedgerEntry<Dim>> entries, const EnergyScale& scale) {
    return {energies<Dim>(entries), errors<Dim>(entries, scale)};
}

template <int Dim>
Markup energy_pictures(const RunResult<Dim>& result) {
    const auto [energies, errors] = energy_plots<Dim>(result.ledger.entries(), result.energy.scale);
    return figure(energies,
                  "Kinetic and potential energy, their sum H, and the pseudo-energy H~ that the scheme conserves.") +
           figure(errors,
                  "What H~ has gained beyond the work W from outside less all that was dissipated, and H - H~, the part of "
                  "H that "
                  "it does not hold. An exact zero, or less, is drawn at the lower end.");
}

template <int Dim>
Markup contact_picture(const RunResult<Dim>& result) {
    const Entries<Dim> entries = result.ledger.entries();
    const auto pairs = values<Dim>(entries, [](const auto& entry) { return static_cast<double>(entry.active_pairs); });
    if (result.contact.report.active_pairs_max == 0) return {};
    return figure({.title = "Pairs in contact over time",
                   .x_label = "time [s]",
                   .y_label = "pairs in contact",
                   .x = times<Dim>(entries),
                   .curves = {{"pairs of faces in contact", "blue", pairs}}},
                  "Pairs of faces that touch, at each record.");
}

#define ABUT_INSTANTIATE(Dim)                                                                                        \
    template std::array<Plot, 2> energy_plots<Dim>(std::span<const dynamics::LedgerEntry<Dim>>, const EnergyScale&); \
    template Markup energy_pictures<Dim>(const RunResult<Dim>&);                                                     \
    template Markup contact_picture<Dim>(const RunResult<Dim>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::run
