#pragma once
// Private to the sources of this layer.
#include <cstddef>

namespace abut::solid {

/// The share of the pull of a place at both ends of a step.
struct BondChange {
    std::size_t place;
    double start;
    double end;
};

/// Energy per area that half cells of this stiffness in series hold at the strength of a bond [J/m^2].
[[nodiscard]] inline double energy_at_strength(double strength, double stiffness) {
    return 0.5 * strength * strength / stiffness;
}

/// The share s of a place that is opened as far as never before: whole it would bear `traction` [Pa], half cells of
/// `stiffness` [Pa/m] being in series with it. The opening w takes what these leave, (1 - s) traction = stiffness w,
/// and the traction falls with it, s traction = strength (1 - w/w_f), from the strength to 0 at w_f = 2 G/strength: G
/// is what that takes.
[[nodiscard]] inline double share_of_bond(double strength, double fracture_energy, double traction, double stiffness) {
    if (traction <= strength) return 1.0;
    const double compliance = 1.0 / stiffness, full = 2.0 * fracture_energy / strength;  // w_f
    const double left = full - traction * compliance;
    if (left <= 0.0 || full <= strength * compliance) return 0.0;  // the half cells hold more than G: it breaks at once
    return left / (full / strength - compliance) / traction;
}

}  // namespace abut::solid
