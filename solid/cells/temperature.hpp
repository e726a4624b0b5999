#pragma once
#include <functional>

#include "abut/base/vector.hpp"

namespace abut::solid {

/// How much warmer a body is than where it has no thermal strain: a given field, which the body does not change.
template <int Dim>
struct TemperatureRise {
    std::function<double(double time, const Vector<Dim>& position)> value;  ///< [K], at a place at rest [m]; empty: 0
    /// Whether it depends on the time: it is constant within a step, and changes where one begins. Else it is that of t = 0
    bool varies = false;
};

}  // namespace abut::solid
