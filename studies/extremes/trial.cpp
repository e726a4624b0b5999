#include "studies/extremes/trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "abut/run/steps/simulation.hpp"

namespace abut::studies::extremes {
namespace {

template <int Dim>
double impulse_scale(const run::RunResult<Dim>& result) {
    double sum = 0.0;
    for (const auto& body : result.bodies.start) sum += body.mass * body.velocity.norm();
    return sum;
}

template <int Dim>
bool all_finite(const run::RunResult<Dim>& result) {
    const auto is_finite = [](const dynamics::LedgerEntry<Dim>& entry) {
        return std::isfinite(entry.energy) && std::isfinite(entry.pseudo_energy) && std::isfinite(entry.parasitic) &&
               entry.linear_momentum.allFinite();
    };
    return std::ranges::all_of(result.ledger.entries(), is_finite) &&
           std::ranges::all_of(result.bodies.end, [](const auto& body) { return body.velocity.allFinite(); });
}

template <int Dim>
std::vector<Number> speeds_at_end(const run::RunResult<Dim>& result, double speed) {
    std::vector<Number> numbers;
    for (std::size_t body = 0; body < result.bodies.end.size(); ++body)
        for (int i = 0; i < Dim; ++i)
            numbers.push_back(
                {fmt::format("speed of body {} along {}", body, "xyz"[i]), result.bodies.end[body].velocity[i] / speed});
    return numbers;
}

template <int Dim>
void append_dimensionless(Row& row, const run::RunResult<Dim>& result) {
    const auto& last = result.ledger.entries().back();
    const double scale = result.energy.scale.value;
    const auto count = [](std::int64_t n) { return static_cast<double>(n); };
    const std::initializer_list<Number> numbers = {{"potential energy", last.potential / scale},
                                                   {"kinetic energy", last.kinetic / scale},
                                                   {"energy", last.energy / scale},
                                                   {"pseudo-energy", last.pseudo_energy / scale},
                                                   {"H - H~", row.excess},
                                                   {"|e|/m", row.parasitic},
                                                   {"compression", row.compression},
                                                   {"steps", count(row.steps)},
                                                   {"events", count(row.events)},
                                                   {"active pairs", count(row.active_pairs_max)},
                                                   {"lists of candidates", count(result.contact.report.rebuilds)},
                                                   {"candidates", count(result.contact.report.candidates_max)},
                                                   {"tilted pairs", count(result.contact.report.tilted_pairs_max)},
                                                   {"pairs not admitted", count(result.contact.inadmissible_overlaps_max)}};
    row.numbers.insert(row.numbers.end(), numbers);
}

/// Why a run that came to its end is not one that holds; empty if it is.
template <int Dim>
std::string defect(const Row& row, const Trial<Dim>& trial) {
    if (!row.is_finite) return "a number of it is not finite";
    if (trial.meets && row.active_pairs_max == 0)
        return fmt::format("the bodies never met; {} corners are too sharp for contact to see", row.blind_corners);
    if (!(row.drift <= largest_drift))
        return fmt::format("H~ drifts by {:.2g}, {:g} of the scale is allowed", row.drift, largest_drift);
    if (trial.keeps_momentum && !(row.momentum <= largest_momentum_drift))
        return fmt::format("momentum drifts by {:.2g}, {:g} is allowed", row.momentum, largest_momentum_drift);
    if (!(row.excess <= largest_excess))
        return fmt::format(
            "H - H~ reaches {:.2g} of the scale, {:g} is allowed; faces that slide off each other are pressed in by {:.2g} "
            "of their width",
            row.excess, largest_excess, row.sliding);
    if (row.missed_contacts > 0) return fmt::format("{} contacts were missed, 0 are allowed", row.missed_contacts);
    return "";
}

template <int Dim>
void measure(Row& row, const Trial<Dim>& trial, const run::RunResult<Dim>& result) {
    static_cast<Figures&>(row) = figures_of(result);
    row.is_finite = all_finite(result);
    row.parasitic /= trial.speed;
    if (trial.keeps_momentum) row.momentum = result.ledger.momentum_drift() / impulse_scale(result);
    row.sliding = result.contact.report.sliding_ratio_max;
    row.slipped = result.contact.report.slipped_compression_max;
    row.active_pairs_max = result.contact.report.active_pairs_max;
    row.blind_corners = static_cast<std::int64_t>(result.contact.blind_corners.size());
    row.numbers = speeds_at_end(result, trial.speed);
    append_dimensionless(row, result);
    row.message = defect(row, trial);
    if (trial.ask_more) {
        const std::string more = trial.ask_more(result, row);
        if (row.message.empty()) row.message = more;
    }
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
Trial<Dim> meeting_of_blocks(const std::string& family, const std::string& value, const Meeting<Dim>& meeting,
                             const std::array<Block<Dim>, 2>& pair, const run::RunOptions& run) {
    return {.family = family,
            .value = value,
            .speed = meeting.speed,
            .make = [meeting, pair] { return blocks<Dim>(meeting, pair); },
            .run = run};
}

template <int Dim>
Row attempt(const Trial<Dim>& trial) {
    Row row;
    row.family = trial.family;
    row.value = trial.value;
    std::int64_t cells = 0;
    try {
        run::Scene<Dim> scene = trial.make();
        // The limits of bodies that do not turn are those of the reconstruction (docs/limits.md).
        if (scene.solid.kinematics.empty()) scene.solid.law = solid::ContactLaw::reconstruction;
        cells = scene.mesh.n_cells();
        measure(row, trial, run::simulate<Dim>(scene, trial.run));
    } catch (const std::exception& error) {
        row.message = error.what();
    }
    row.cells = cells;
    return row;
}

void compare(Row& row, const Row& reference, std::size_t how_many, double allowed) {
    if ((row.verdict == Verdict::refused) != (reference.verdict == Verdict::refused)) {
        row.message = fmt::format("it is {}, and the same run as it was is {}. {}", name_of(row.verdict),
                                  name_of(reference.verdict), row.message);
        row.verdict = Verdict::failed;
        return;
    }
    if (row.verdict == Verdict::refused || row.numbers.size() != reference.numbers.size()) return;
    row.deviation = 0.0;
    std::string worst;
    for (std::size_t i = 0; i < std::min(how_many, row.numbers.size()); ++i) {
        const double value = reference.numbers[i].value;
        const double deviation = std::abs(row.numbers[i].value - value) / std::max(1.0, std::abs(value));
        if (deviation <= row.deviation) continue;
        row.deviation = deviation;
        worst = row.numbers[i].name;
    }
    if (row.deviation <= allowed) return;
    row.verdict = Verdict::failed;
    if (!row.message.empty()) row.message += "; ";
    row.message += fmt::format("{} differs by {:.2g}, {:.2g} is allowed", worst, row.deviation, allowed);
}

template Trial<2> meeting_of_blocks(const std::string&, const std::string&, const Meeting<2>&,
                                    const std::array<Block<2>, 2>&, const run::RunOptions&);
template Row attempt<2>(const Trial<2>&);
template Trial<3> meeting_of_blocks(const std::string&, const std::string&, const Meeting<3>&,
                                    const std::array<Block<3>, 2>&, const run::RunOptions&);
template Row attempt<3>(const Trial<3>&);

}  // namespace abut::studies::extremes
