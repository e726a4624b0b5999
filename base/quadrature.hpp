#pragma once
#include <array>
#include <cassert>
#include <cmath>

namespace abut {

/// Nodes and weights on [0, 1].
struct Quadrature {
    int size;
    std::array<double, 3> node;
    std::array<double, 3> weight;
};

/// Gauss-Legendre with 1, 2 or 3 points: exact up to degree 1, 3, 5.
[[nodiscard]] inline Quadrature gauss_legendre(int points) {
    assert(points >= 1 && points <= 3);
    const double two = 0.5 / std::sqrt(3.0);
    const double three = 0.5 * std::sqrt(0.6);
    if (points == 1) return {1, {0.5}, {1.0}};
    if (points == 2) return {2, {0.5 - two, 0.5 + two}, {0.5, 0.5}};
    return {3, {0.5 - three, 0.5, 0.5 + three}, {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0}};
}

}  // namespace abut
