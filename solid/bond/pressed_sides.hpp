#pragma once
// Private to the sources of this layer.
#include <algorithm>

namespace abut::solid {

/// Distance of the sides of a place along its normal where they press on each other [m], else 0. Pressure and its energy
/// follow from it, and do not fall with the share of the bond.
struct PressedSides {
    double mean;      ///< of both ends of a step
    double gradient;  ///< of half its square, over the change of the distance: that is what pushes
    double slope;     ///< its change over that of the distance [-]
};

/// In one state at this distance [m].
[[nodiscard]] inline PressedSides pressed_at(double distance) {
    const double pressed = std::min(distance, 0.0);
    return {pressed, pressed, distance < 0.0 ? 1.0 : 0.0};
}

/// As if they always did: for the stable step.
[[nodiscard]] inline PressedSides always_pressed(double distance) { return {distance, distance, 1.0}; }

/// Along a step from one distance to another one [m].
[[nodiscard]] inline PressedSides pressed_along(double start, double end) {
    const double pressed_0 = std::min(start, 0.0), pressed_1 = std::min(end, 0.0), mean = 0.5 * (pressed_0 + pressed_1);
    if (start == end || (start <= 0.0 && end <= 0.0)) return {mean, mean, start < 0.0 || end < 0.0 ? 1.0 : 0.0};
    const double slope = (pressed_1 - pressed_0) / (end - start);
    return {mean, mean * slope, slope};
}

}  // namespace abut::solid
