#pragma once
// Private to the sources of this layer.
#include <cmath>
#include <cstdint>

#include "abut/base/large_array.hpp"
#include "abut/solid/operator/lanes.hpp"

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

/// Square root of the largest squared(tensor) of the tensors [begin, end). The result is NaN if any of them is.
template <int Dim, class Real, class Squared>
[[nodiscard]] double largest_root(const LargeArray<Real>& tensors, std::int32_t begin, std::int32_t end,
                                  const Squared& squared) {
    double largest = 0.0;
    for (std::int32_t i = begin; i < end; ++i) {
        const double value = squared(load_tensor<Dim>(tensors, i));
        largest = value <= largest || std::isnan(largest) ? largest : value;
    }
    return std::sqrt(largest);
}

}  // namespace abut::solid
