#pragma once
// For tests that keep the largest of many values and check it after the loop.
#include <limits>

namespace abut::test {

/// Raises `worst` to `value` if that is larger, or NaN; NaN stays. std::max would drop it, and a state that has diverged
/// would pass for a small one.
constexpr void raise(double& worst, double value) {
    if (worst < value || value != value) worst = value;
}

static_assert([] {
    double worst = 1.0;
    raise(worst, std::numeric_limits<double>::quiet_NaN());
    raise(worst, 2.0);
    return worst != worst;
}());

}  // namespace abut::test
