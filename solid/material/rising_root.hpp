#pragma once
// Private to the sources of this layer.
#include <cmath>

namespace abut::solid {

/// The root between `low` and `high` of a function that rises, is not positive at `low` and not negative at `high`, to
/// a rounding of `high`: by Newton's method from `low`, or by bisection where it leaves the bracket, does not halve its
/// steps, or knows no slope. `function(x)` returns value and slope.
template <class Function>
[[nodiscard]] double rising_root(const Function& function, double low, double high) {
    constexpr int most_steps = 200;
    const double rounding = 1e-16 * high;
    double x = low, step = high - low, step_before = step;
    for (int i = 0; i < most_steps; ++i) {
        const auto [value, slope] = function(x);
        (value < 0.0 ? low : high) = x;
        double next = x - value / slope;
        const bool slows_down = std::abs(next - x) > 0.5 * step_before;
        if (!std::isfinite(slope) || slows_down || !(next >= low && next <= high)) next = 0.5 * (low + high);
        step_before = step;
        step = std::abs(next - x);
        if (step <= rounding) break;
        x = next;
    }
    return x;
}

}  // namespace abut::solid
