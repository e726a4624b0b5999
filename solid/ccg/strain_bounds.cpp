// How far cells are strained, at most: what a look at the limits of erosion need not go beyond.
#include <algorithm>
#include <cmath>

#include "abut/base/parallel.hpp"
#include "abut/solid/ccg/finite_cell.hpp"
#include "abut/solid/ccg/sweeps.hpp"

namespace abut::solid {
namespace {

template <int Dim>
double squared_norm(const LaneTensor<Dim>& tensor) {
    double sum = 0.0;
    for (int j = 0; j < Dim; ++j) sum += dot(tensor.col[j], tensor.col[j]);
    return sum;
}

template <int Dim>
double squared_norm_of_strain(const LaneTensor<Dim>& g, bool is_finite) {
    if (is_finite) return squared_norm<Dim>(green_strain(g));
    const LaneTensor<Dim> turned = transpose(g);
    LaneTensor<Dim> twice;
    for (int j = 0; j < Dim; ++j) twice.col[j] = g.col[j] + turned.col[j];
    return 0.25 * squared_norm<Dim>(twice);
}

}  // namespace

/// Largest |eps| of a chunk at most, from what the sweep has just written: |G|, |E| or, of simplices, that of the elastic
/// stress over the least modulus; sums of squares are larger by a factor of Dim at most, as each lane has its own largest.
template <int Dim, class Real>
void CcgSweeps<Dim, Real>::bound_strains_of_chunk(std::int32_t k) {
    const Chunk& chunk = chunks_[k];
    const auto largest_of = [&](const auto& tensor_of) {
        Lanes<Dim> largest;
        for (std::int32_t c = chunk.cell; c < chunks_[k + 1].cell; ++c) {
            const LaneTensor<Dim> tensor = tensor_of(c);
            Lanes<Dim> squares{tensor.col[0].r * tensor.col[0].r};
            for (int j = 1; j < Dim; ++j) squares.r += tensor.col[j].r * tensor.col[j].r;
            largest.r = squares.r > largest.r ? squares.r : largest.r;
        }
        double sum = 0.0;
        for (int i = 0; i < Dim; ++i) sum += largest[i];
        return std::sqrt(sum);
    };
    if (chunk.has_finite) {
        strain_bounds_[k] = largest_of([&](std::int32_t c) { return green_strain(load_tensor<Dim>(g_, c)); });
    } else if (chunk.simplices) {
        const CellGeometry<Dim, Real>& cell = coefficients_.cells[chunk.cell];  // all are of one body
        const double modulus = 2.0 * cell.mu + std::min(0.0, Dim * cell.lambda);
        strain_bounds_[k] = largest_of([&](std::int32_t c) { return load_tensor<Dim>(s_, c); }) / modulus;
    } else {
        strain_bounds_[k] = largest_of([&](std::int32_t c) { return load_tensor<Dim>(g_, c); });
    }
}

template <int Dim, class Real>
std::vector<std::int32_t> CcgSweeps<Dim, Real>::strained_beyond(std::span<const double> limit_of_body) const {
    std::vector<std::int32_t> cells;
    std::size_t body = 0;
    for (std::size_t k = 0; k < strain_bounds_.size(); ++k) {
        while (chunks_[k].cell >= arrays_.body_begin[body + 1]) ++body;
        const double limit = limit_of_body[body];
        if (strain_bounds_[k] < limit) continue;
        for (std::int32_t c = chunks_[k].cell; c < chunks_[k + 1].cell; ++c) {
            const bool is_below = std::sqrt(squared_norm_of_strain<Dim>(present_gradient(c), finite_.contains(c))) < limit;
            if (!is_below) cells.push_back(c);
        }
    }
    return cells;
}

#define ABUT_INSTANTIATE(Dim)                                           \
    template void CcgSweeps<Dim>::bound_strains_of_chunk(std::int32_t); \
    template std::vector<std::int32_t> CcgSweeps<Dim>::strained_beyond(std::span<const double>) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
