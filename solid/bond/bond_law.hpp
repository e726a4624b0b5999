#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstddef>

namespace abut::solid {

/// The share of the pull of a place at both ends of a step and of its mean force.
struct BondChange {
    std::size_t place;
    double start;
    double end;
    double middle;
    double opening;    ///< at the end, over that of a broken place [-]; 1 without a fracture energy
    double taken;      ///< what its law takes in the step; after Bonds::share_loss what it has lost [J/m^2]
    double stiffness;  ///< of both half cells in the direction of the traction [Pa/m]
    double rise;       ///< of what a whole place holds, in the step [J/m^2]
    double pressed;    ///< energy by which its sides press on each other at the end, before shares change [J/m^2]
};

/// Pull on a whole place at an end of a step; with a fracture energy without its pressure, which does not fall with the
/// share.
struct BondPull {
    double traction;   ///< its size [Pa]
    double stiffness;  ///< of both half cells in its direction [Pa/m]
    double held_0;     ///< energy of it at the start of the step [J/m^2]
    bool pulls_apart;  ///< its sides
    double pressed;    ///< energy by which they press on each other [J/m^2]
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

/// The opening over w_f of a place that has this share [-], half cells of `stiffness` [Pa/m] being in series with it. Its
/// law has taken as much of the fracture energy, however the place is loaded.
[[nodiscard]] inline double opening_of_bond(double strength, double fracture_energy, double share, double stiffness) {
    const double open = strength * (1.0 - share), held = share * 2.0 * fracture_energy / strength * stiffness;
    return open + held > 0.0 ? open / (open + held) : 1.0;
}

/// The share of a place with this opening: opening_of_bond the other way round.
[[nodiscard]] inline double share_of_opening(double strength, double fracture_energy, double opening, double stiffness) {
    const double left = strength * (1.0 - opening);
    return left > 0.0 ? left / (left + opening * 2.0 * fracture_energy / strength * stiffness) : 0.0;
}

/// The share of the mean force of a step. Whole, the place holds `held_0` at its start and `held_1` at its end [J/m^2]. As
/// its share falls to the middle at the start, and from there at the end, it loses `taken` [J/m^2], if that lies between
/// what it would lose at either end.
[[nodiscard]] inline double middle_share(double start, double end, double held_0, double held_1, double taken) {
    if (held_1 == held_0) return 0.5 * (start + end);
    const double middle = (start * held_0 - end * held_1 - taken) / (held_0 - held_1);
    return std::clamp(middle, end, start);
}

/// The part of the energy `pressed` of sides whose places broke in one step that contact begins with, so that it holds
/// `lost` [J] at most, which V of the bonds has lost; 0.1 at least: half cells press on several faces of a cell with less
/// energy than contact does.
[[nodiscard]] inline double handed_over_part(double pressed, double lost) {
    constexpr double least = 0.1;
    return pressed > lost ? std::max(lost / pressed, least) : 1.0;
}

}  // namespace abut::solid
