// How far cells are strained, at most: what a look at the limits of erosion need not go beyond.
#include <algorithm>
#include <cmath>

#include "abut/solid/ccg/largest_strain.hpp"
#include "abut/solid/ccg/sweeps.hpp"

namespace abut::solid {
namespace {

template <int Dim>
double norm_of_strain(const LaneTensor<Dim>& g, bool is_finite) {
    if (is_finite) return std::sqrt(squared_green_strain(g));
    const LaneTensor<Dim> turned = transpose(g);
    LaneTensor<Dim> twice;
    for (int j = 0; j < Dim; ++j) twice.col[j] = g.col[j] + turned.col[j];
    return 0.5 * std::sqrt(squared_norm(twice));
}

}  // namespace

/// At most, from what the sweep has just written: |G|, |E| or, of simplices, that of the elastic stress over the least
/// modulus.
template <int Dim, class Real>
double CcgSweeps<Dim, Real>::largest_strain_of_chunk(std::int32_t k) const {
    const auto largest_of = [&](const LargeArray<Real>& tensors, const auto& squared) {
        double largest = 0.0;
        for (std::int32_t c = chunks_[k].cell; c < chunks_[k + 1].cell; ++c) {
            const double value = squared(load_tensor<Dim>(tensors, c));
            largest = value <= largest ? largest : value;
        }
        return std::sqrt(largest);
    };
    const auto norm = [](const auto& tensor) { return squared_norm<Dim>(tensor); };
    if (chunks_[k].has_finite) return largest_of(work_.g, [](const auto& g) { return squared_green_strain<Dim>(g); });
    if (!chunks_[k].simplices) return largest_of(work_.g, norm);
    const auto& [inverse_measure, lambda, mu] = coefficients_.cells[chunks_[k].cell];  // all are of one material
    return largest_of(work_.s, norm) / (2.0 * mu + std::min(0.0, double{Dim} * lambda));
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
            const bool is_below = norm_of_strain<Dim>(present_gradient(c), finite_.contains(c)) < limit;
            if (!is_below) cells.push_back(c);
        }
    }
    return cells;
}

template double CcgSweeps<2, float>::largest_strain_of_chunk(std::int32_t) const;
template double CcgSweeps<3, float>::largest_strain_of_chunk(std::int32_t) const;
#define ABUT_INSTANTIATE(Dim)                                                    \
    template double CcgSweeps<Dim>::largest_strain_of_chunk(std::int32_t) const; \
    template std::vector<std::int32_t> CcgSweeps<Dim>::strained_beyond(std::span<const double>) const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
