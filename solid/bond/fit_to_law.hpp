#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cmath>

namespace abut::solid {

/// How far places open in a step: 1 as far as their tractions say, 0 not at all; and the share of their mean force, 0 that
/// which each has alone, 1 that of the end of the step at which most is lost, -1 that of the other one.
struct BondOpening {
    double extent = 1.0;
    double middle = 0.0;
};

/// Looks for a root of f, which has values of opposite signs at a and b, to `tolerance` and in twelve trials at most: by the
/// rule of Illinois.
template <class Function>
void find_root(double a, double at_a, double b, double at_b, double tolerance, const Function& f) {
    constexpr int most_trials = 12;
    for (int trial = 0; trial < most_trials && std::abs(at_b) > tolerance; ++trial) {
        const double next = (a * at_b - b * at_a) / (at_b - at_a), at_next = f(next);
        if (at_next * at_b < 0.0) {
            a = b;
            at_a = at_b;
        } else {
            at_a *= 0.5;  // else a would stay where it is
        }
        b = next;
        at_b = at_next;
    }
}

/// Opens places so that what they lose together is what their laws take, to 1e-3 of it: by the share of their mean force,
/// and where they lose too little even so by opening less, an eighth of that at least. `excess(opening)` opens them so, and
/// returns what is lost beyond that, over what laws take of openings of 1 [-]. It is called last with the opening that is
/// chosen: the nearest, if none fits. `slopes`: by how much it grows with the middle towards 1 and -1, if no place knew of
/// another one.
template <class Excess>
void fit_to_law(const Excess& excess, const std::array<double, 2>& slopes) {
    constexpr double tolerance = 1e-3, least_extent = 0.125;
    const double alone = excess(BondOpening{});
    if (std::abs(alone) <= tolerance) return;
    const double end = alone < 0.0 ? 1.0 : -1.0;  // 1: with it most is lost
    const auto by_middle = [&](double middle) { return excess(BondOpening{.middle = end * middle}); };
    const double slope = slopes[end > 0.0 ? 0 : 1];
    const double guess = slope > 0.0 ? std::min(std::abs(alone) / slope, 1.0) : 1.0, at_guess = by_middle(guess);
    if (alone * at_guess <= 0.0) {
        find_root(0.0, alone, guess, at_guess, tolerance, by_middle);
        return;
    }
    const double at_end = guess < 1.0 ? by_middle(1.0) : at_guess;
    if (alone * at_end <= 0.0) {
        find_root(guess, at_guess, 1.0, at_end, tolerance, by_middle);
        return;
    }
    if (at_end >= -tolerance) return;  // opening further would take more, and makes steps unstable
    const auto by_extent = [&](double extent) { return excess(BondOpening{.extent = extent, .middle = end}); };
    const double at_extent = by_extent(least_extent);
    if (at_extent >= 0.0) find_root(1.0, at_end, least_extent, at_extent, tolerance, by_extent);
}

}  // namespace abut::solid
