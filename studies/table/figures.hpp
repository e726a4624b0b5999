#pragma once
#include <cstdint>
#include <string>

#include "abut/run/result.hpp"

namespace abut::studies {

/// Measures of a run. Energies are over the scale, momenta over the sum of their sizes at the start. NaN: not asked, or not
/// known. No energy is claimed without `excess`, `parasitic` and `events` beside it (docs/method.md, Time).
struct Figures {
    std::int64_t cells = 0;
    std::int64_t steps = 0;                  ///< taken
    double dt = 0.0;                         ///< [s]
    run::EnergyScale scale{};                ///< of energies [J]
    double drift = run::not_given;           ///< max |H~ - H~0 - work|
    double energy_drift = run::not_given;    ///< max |H - H0 - work|
    double excess = run::not_given;          ///< max (H - H~)
    double parasitic = run::not_given;       ///< max |e|/m [m/s]; in some tables over a speed
    double momentum = run::not_given;        ///< drift over sum |p|
    double angular = run::not_given;         ///< drift of sum x × p over sum |x × p|
    double pseudo_angular = run::not_given;  ///< drift of J~ over the same
    double rest_angular = run::not_given;    ///< drift of sum X × p about positions at rest over the same
    std::int64_t events = 0;                 ///< contacts begun or ended
    std::int64_t missed_contacts = 0;        ///< must stay 0
    std::int64_t pair_steps = 0;             ///< pairs of the pair potential, summed over the steps
    double compression = run::not_given;     ///< largest |g|/D
    double correction = run::not_given;      ///< sum of corrections over sum of forces
    double correction_max = run::not_given;  ///< the largest of a step
    bool is_complete = false;                ///< the run has come to its end
    std::string ending{};                    ///< why it has not
    std::string unseen_edges{};              ///< of bodies that may go through each other; empty: none
    double seconds = 0.0;                    ///< with the set-up
    double seconds_of_steps = 0.0;           ///< without set-up, energies and files
};

/// Figures of a finished run that its ledger and its report of contact know; momenta are not among them.
template <int Dim>
[[nodiscard]] Figures figures_of(const run::RunResult<Dim>& result);

/// The sizes that drifts of momenta are quoted on: of all points, at the start.
struct MomentumScales {
    double linear = 0.0;   ///< sum |p| [kg m/s]
    double angular = 0.0;  ///< sum |x × p| [kg m^2/s]
};
template <int Dim>
[[nodiscard]] MomentumScales momentum_scales(const dynamics::RunView<Dim>& run, std::span<const Vector<Dim>> rest_positions);

}  // namespace abut::studies
