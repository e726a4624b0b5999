#pragma once
// Private to the layer.
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::geometry {

/// n_1 . n_2 above which the normal of a pair is not asked for.
inline constexpr double no_normal_cosine = 0.3;

/// n_1 . n_2.
[[nodiscard]] inline double facing_cosine(const PairCorners<2>& x) {
    const Vector<2> edge_1 = x[1] - x[0], edge_2 = x[3] - x[2];
    return edge_1.dot(edge_2) / (edge_1.norm() * edge_2.norm());
}
[[nodiscard]] inline double facing_cosine(const PairCorners<3>& x) {
    const Vector<3> area_1 = (x[1] - x[0]).cross(x[2] - x[0]), area_2 = (x[4] - x[3]).cross(x[5] - x[3]);
    return area_1.dot(area_2) / (area_1.norm() * area_2.norm());
}

}  // namespace abut::geometry
