#pragma once
#include <vector>

namespace abut::solid {

/// A row of MetalFlow::table.
struct HardeningPoint {
    double plastic_strain;  ///< alpha [-]
    double stress;          ///< at which metal flows there [Pa]
};

/// Flow of a metal of MaterialLaw::j2. With alpha the equivalent plastic strain, slow flow takes the stress
///
///     sigma(alpha) = yield_stress + hardening alpha + saturation (1 - exp(-saturation_rate alpha))
///                    + power_hardening alpha^power_exponent,
///
/// or that of `table`. A rate r of alpha multiplies it by 1 + (r/cowper_symonds_rate)^(1/cowper_symonds_exponent), or by
/// 1 + johnson_cook_factor ln(r/johnson_cook_rate) above johnson_cook_rate.
struct MetalFlow {
    double yield_stress = 0.0;     ///< [Pa], > 0
    double hardening = 0.0;        ///< [Pa], >= 0: per plastic strain
    double saturation = 0.0;       ///< Voce's rise of the yield stress in the end [Pa], >= 0
    double saturation_rate = 0.0;  ///< per plastic strain [-]; > 0 with `saturation`
    double power_hardening = 0.0;  ///< Ludwik's, and Johnson and Cook's B [Pa], >= 0
    double power_exponent = 0.0;   ///< their n [-], in (0, 1] with `power_hardening`
    /// In the place of all of these: from alpha = 0, where it is `yield_stress`, with growing alpha and stresses that
    /// do not fall. Straight between two rows, constant behind the last.
    std::vector<HardeningPoint> table{};
    double cowper_symonds_rate = 0.0;      ///< D [1/s], >= 0; 0: the rate does not count
    double cowper_symonds_exponent = 0.0;  ///< q [-], >= 1 with `cowper_symonds_rate`
    double johnson_cook_rate = 0.0;        ///< r at which the stress is sigma(alpha) [1/s], >= 0; 0: the rate does not count
    double johnson_cook_factor = 0.0;      ///< C [-], > 0 with `johnson_cook_rate`
    /// Prager's: by how much yielding shifts the stresses at which it does, per plastic strain [Pa], >= 0.
    double kinematic_hardening = 0.0;
    /// Largest traction of the stabilisation of jumps between cells over `yield_stress` [-], >= 0; 0: 0.1 where both
    /// cells are simplices and 0.3 elsewhere, none in finite bodies that contact may push.
    double jump_cap = 0.0;

    /// sigma(alpha) [Pa].
    [[nodiscard]] double stress(double plastic_strain) const;
    /// Its slope [Pa].
    [[nodiscard]] double slope(double plastic_strain) const;
    /// Its integral from 0: the work of slow flow per volume [J/m^3].
    [[nodiscard]] double work(double plastic_strain) const;
    /// Factor by which a rate of the plastic strain [1/s] multiplies it [-], 1 or more.
    [[nodiscard]] double rate_factor(double rate) const;
    [[nodiscard]] bool knows_rates() const { return cowper_symonds_rate > 0.0 || johnson_cook_rate > 0.0; }
};

}  // namespace abut::solid
