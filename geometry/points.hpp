#pragma once
#include <span>

#include "abut/base/vector.hpp"
#include "abut/geometry/box.hpp"

namespace abut::geometry {

/// Mean of points, one at least [m].
template <int Dim>
[[nodiscard]] Vector<Dim> mean_of(std::span<const Vector<Dim>> points) {
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (const Vector<Dim>& x : points) sum += x;
    return sum / static_cast<double>(points.size());
}

/// Box around points; empty where there is none.
template <int Dim>
[[nodiscard]] Box<Dim> box_of(std::span<const Vector<Dim>> points) {
    Box<Dim> box;
    for (const Vector<Dim>& x : points) box.extend(x);
    return box;
}

}  // namespace abut::geometry
