#pragma once
// Private to the sources of this layer.
#include "abut/solid/ccg/lanes.hpp"

namespace abut::solid {

template <int Dim, class Real>
[[nodiscard]] inline Real squared_norm(const LaneTensor<Dim, Real>& tensor) {
    auto squares = tensor.col[0].r * tensor.col[0].r;
    for (int j = 1; j < Dim; ++j) squares += tensor.col[j].r * tensor.col[j].r;
    return Dim == 2 ? squares[0] + squares[1] : squares[0] + squares[1] + squares[Dim - 1];
}

/// |E|^2 of Green's strain, 2 E_ij = g_ij + g_ji + g_i . g_j with the columns g_i of the displacement gradient.
template <int Dim, class Real>
[[nodiscard]] inline Real squared_green_strain(const LaneTensor<Dim, Real>& g) {
    Real four_times = 0;
    for (int i = 0; i < Dim; ++i)
        for (int j = i; j < Dim; ++j) {
            const Real twice = g.col[i][j] + g.col[j][i] + dot(g.col[i], g.col[j]);
            four_times += (i == j ? 1 : 2) * twice * twice;
        }
    return four_times / 4;
}

}  // namespace abut::solid
