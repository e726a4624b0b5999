#include "extremes/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "support/simulation.hpp"

namespace abut::examples::extremes {
namespace {

template <int Dim>
double impulse_scale(const RunResult<Dim>& result) {
    double sum = 0.0;
    for (const auto& body : result.start) sum += body.mass * body.velocity.norm();
    return sum;
}

template <int Dim>
bool all_finite(const RunResult<Dim>& result) {
    const auto is_finite = [](const dynamics::LedgerEntry<Dim>& entry) {
        return std::isfinite(entry.energy) && std::isfinite(entry.pseudo_energy) && std::isfinite(entry.parasitic) &&
               entry.linear_momentum.allFinite();
    };
    return std::ranges::all_of(result.ledger.entries(), is_finite) &&
           std::ranges::all_of(result.end, [](const auto& body) { return body.velocity.allFinite(); });
}

/// Speeds at the end, energies, counts: all without a unit.
template <int Dim>
std::vector<double> dimensionless(const Row& row, const RunResult<Dim>& result, double speed) {
    std::vector<double> numbers;
    for (const auto& body : result.end)
        for (int i = 0; i < Dim; ++i) numbers.push_back(body.velocity[i] / speed);
    const auto& last = result.ledger.entries().back();
    for (const double energy : {last.potential, last.kinetic, last.energy, last.pseudo_energy})
        numbers.push_back(energy / result.scale.value);
    for (const double number : {row.excess, row.parasitic, row.compression}) numbers.push_back(number);
    for (const std::int64_t count : {row.steps, row.events, row.active_pairs_max, result.contact.rebuilds,
                                     result.contact.candidates_max, result.not_admitted_max})
        numbers.push_back(static_cast<double>(count));
    return numbers;
}

/// Why a run that came to its end is not one that holds; empty if it is.
std::string defect(const Row& row, bool keeps_momentum) {
    if (!row.is_finite) return "a number of it is not finite";
    if (!(row.drift <= largest_drift))
        return fmt::format("H~ drifts by {:.2g}, {:g} of the scale is allowed", row.drift, largest_drift);
    if (keeps_momentum && !(row.momentum <= largest_momentum_drift))
        return fmt::format("momentum drifts by {:.2g}, {:g} is allowed", row.momentum, largest_momentum_drift);
    if (!(row.excess <= largest_excess))
        return fmt::format("H - H~ reaches {:.2g} of the scale, {:g} is allowed", row.excess, largest_excess);
    if (row.lost_contacts > 0) return fmt::format("{} contacts were lost, 0 are allowed", row.lost_contacts);
    return "";
}

template <int Dim>
void measure(Row& row, const Trial<Dim>& trial, const RunResult<Dim>& result) {
    row.is_finite = all_finite(result);
    row.drift = result.ledger.pseudo_energy_drift() / result.scale.value;
    row.excess = result.ledger.energy_excess() / result.scale.value;
    row.parasitic = result.ledger.parasitic() / trial.speed;
    if (trial.keeps_momentum) row.momentum = result.ledger.momentum_drift() / impulse_scale(result);
    row.compression = result.contact.compression_max;
    row.steps = result.steps;
    row.events = result.contact.events;
    row.lost_contacts = result.contact.lost_contacts;
    row.active_pairs_max = result.contact.active_pairs_max;
    row.numbers = dimensionless(row, result, trial.speed);
    row.message = defect(row, trial.keeps_momentum);
    row.verdict = row.message.empty() ? Verdict::held : Verdict::failed;
}

}  // namespace

std::string name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::held:
            return "held";
        case Verdict::refused:
            return "refused";
        case Verdict::failed:
            return "FAILED";
    }
    return "";
}

template <int Dim>
Row attempt(const Trial<Dim>& trial) {
    Row row{.family = trial.family, .value = trial.value};
    try {
        const Scene<Dim> scene = trial.make();
        row.cells = scene.mesh.n_cells();
        measure(row, trial, simulate<Dim>(scene, trial.run));
    } catch (const std::exception& error) {
        row.message = error.what();
    }
    return row;
}

void compare(Row& row, const Row& reference) {
    if (row.verdict == Verdict::refused || row.numbers.size() != reference.numbers.size()) return;
    row.deviation = 0.0;
    for (std::size_t i = 0; i < row.numbers.size(); ++i)
        row.deviation = std::max(
            row.deviation, std::abs(row.numbers[i] - reference.numbers[i]) / std::max(1.0, std::abs(reference.numbers[i])));
    if (row.deviation <= largest_deviation) return;
    row.verdict = Verdict::failed;
    row.message = fmt::format("a dimensionless number differs by {:.2g}, {:g} is allowed", row.deviation, largest_deviation);
}

template Row attempt<2>(const Trial<2>&);
template Row attempt<3>(const Trial<3>&);

}  // namespace abut::examples::extremes
