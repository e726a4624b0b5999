#include "studies/table/figures.hpp"

namespace abut::studies {

template <int Dim>
Figures figures_of(const run::RunResult<Dim>& result) {
    const double scale = result.energy.scale.value;
    return {.steps = result.run.steps,
            .dt = result.run.dt,
            .scale = result.energy.scale,
            .drift = result.ledger.pseudo_energy_drift() / scale,
            .energy_drift = result.ledger.energy_drift() / scale,
            .excess = result.ledger.energy_excess() / scale,
            .parasitic = result.ledger.parasitic(),
            .events = result.contact.report.events,
            .missed_contacts = result.contact.report.missed_contacts,
            .compression = result.contact.report.compression_max,
            .is_complete = true};
}

template <int Dim>
MomentumScales momentum_scales(const dynamics::RunView<Dim>& run, std::span<const Vector<Dim>> rest_positions) {
    const auto u = as_vectors<Dim>(run.q);
    MomentumScales scales;
    for (std::size_t i = 0; i < u.size(); ++i) {
        const Vector<Dim> p = run.momentum(static_cast<std::ptrdiff_t>(i));
        scales.linear += p.norm();
        scales.angular += moment<Dim>(Vector<Dim>(rest_positions[i] + u[i]), p).norm();
    }
    return scales;
}

template Figures figures_of<2>(const run::RunResult<2>&);
template Figures figures_of<3>(const run::RunResult<3>&);
template MomentumScales momentum_scales<1>(const dynamics::RunView<1>&, std::span<const Vector<1>>);
template MomentumScales momentum_scales<2>(const dynamics::RunView<2>&, std::span<const Vector<2>>);
template MomentumScales momentum_scales<3>(const dynamics::RunView<3>&, std::span<const Vector<3>>);

}  // namespace abut::studies
