#include "abut/solid/operator/motion_bound.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::solid {
namespace {

constexpr double of_rounding = 1e-12;

/// Not below the spectral norm; it for multiples of the identity.
template <int Dim>
double norm_bound(const Matrix<Dim>& m) {
    const Matrix<Dim> sizes = m.cwiseAbs();
    const double columns = (sizes.transpose() * Vector<Dim>::Ones()).maxCoeff(),
                 rows = (sizes * Vector<Dim>::Ones()).maxCoeff();
    return std::min(m.norm(), std::sqrt(columns * rows));
}

}  // namespace

template <int Dim>
MotionBound<Dim>::MotionBound(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces)
    : arrays_(arrays), faces_(faces.begin(), faces.end()), offsets_{0} {
    const BoundaryReconstruction<Dim>& boundary = arrays.boundary;
    for (const BoundaryFace face : faces_) {
        cells_.push_back(arrays.cell_of(face));
        cells_.insert(cells_.end(), boundary.cells.begin() + boundary.offsets[number_of(face)],
                      boundary.cells.begin() + boundary.offsets[number_of(face) + 1]);
    }
    sort_unique(cells_);
    const auto position = [&](std::int32_t cell) {
        return static_cast<std::int32_t>(std::ranges::lower_bound(cells_, cell) - cells_.begin());
    };
    for (const BoundaryFace face : faces_) {
        const std::int32_t b = number_of(face);
        own_.push_back(position(arrays.cell_of(face)));
        kept_.push_back(spectral_norm(Matrix<Dim>(Matrix<Dim>::Identity() - boundary.deficit[b])));
        for (std::int32_t i = boundary.offsets[b]; i < boundary.offsets[b + 1]; ++i) {
            positions_.push_back(position(boundary.cells[i]));  // the face's own: du_c - du_c = 0
            norms_.push_back(positions_.back() == own_.back() ? 0.0 : spectral_norm(boundary.weights[i]));
        }
        norm_sum_.push_back(std::accumulate(norms_.begin() + offsets_.back(), norms_.end(), 0.0));
        offsets_.push_back(static_cast<std::int32_t>(norms_.size()));
        amplification_ = std::max(amplification_, (1.0 + of_rounding) * (kept_.back() + 2.0 * norm_sum_.back()));
    }
    moved_.resize(lane_width<Dim> * cells_.size());
}

template <int Dim>
CornerWeights MotionBound<Dim>::corner_weights(BoundaryFace face, const Vector<Dim>& arm, const Matrix<Dim>& free) const {
    const std::int32_t own = arrays_.cell_of(face);
    std::vector<std::pair<std::int32_t, Matrix<Dim>>> row;  // weights of cells
    const auto add = [&](std::int32_t cell, const Matrix<Dim>& weight) {
        const auto found = std::ranges::find(row, cell, &std::pair<std::int32_t, Matrix<Dim>>::first);
        if (found == row.end())
            row.emplace_back(cell, weight);
        else
            found->second += weight;
    };
    const BoundaryReconstruction<Dim>& boundary = arrays_.boundary;
    const auto add_boundary_face = [&](BoundaryFace b, double share) {  // share (û_b - u_own)
        for (std::int32_t i = boundary.offsets[number_of(b)]; i < boundary.offsets[number_of(b) + 1]; ++i) {
            add(boundary.cells[i], share * boundary.weights[i]);
            add(own, -share * boundary.weights[i]);
        }
        add(own, -share * boundary.deficit[number_of(b)]);
    };
    add(own, Matrix<Dim>::Identity());
    add_boundary_face(face, 1.0);
    for (const HalfFace& half_face : arrays_.half_faces_of(own)) {
        const auto area = Vector<Dim>(arrays_.faces[half_face.face].area_vector.data());
        const double share = (half_face.first == own ? 1.0 : -1.0) * arrays_.cells[own].inverse_measure * area.dot(arm);
        if (const BoundaryFace b = arrays_.boundary_index[half_face.face]; b != no_face) {
            add_boundary_face(b, share);
            continue;
        }
        const FaceStencil<Dim>& stencil = arrays_.stencils[half_face.face];
        for (int j = 0; j <= Dim; ++j) add(stencil.cells[j], share * stencil.weights[j] * Matrix<Dim>::Identity());
        add(own, -share * Matrix<Dim>::Identity());
    }
    CornerWeights weights;
    Matrix<Dim> sum = Matrix<Dim>::Zero();
    for (const auto& [cell, weight] : row) {
        const Matrix<Dim> freed = free * weight;
        sum += freed;
        const double norm = (1.0 + of_rounding) * norm_bound<Dim>(freed);
        if (cell == own)
            weights.own = norm;
        else if (norm > 0.0)
            weights.others.emplace_back(cell, norm);
    }
    weights.sum = (1.0 + of_rounding) * norm_bound<Dim>(sum);
    weights.missing = norm_bound<Dim>(Matrix<Dim>(Matrix<Dim>::Identity() - sum)) + of_rounding;
    return weights;
}

template <int Dim>
double MotionBound<Dim>::of_face(std::size_t i) const {
    const Lanes<Dim> own = load_packed<Dim>(moved_, own_[i]);
    Lanes<Dim> squares;  // by direction
    for (std::int32_t k = offsets_[i]; k < offsets_[i + 1]; ++k) {
        const Lanes<Dim> relative = load_packed<Dim>(moved_, positions_[k]) - own;
        squares.r += norms_[k] * relative.r * relative.r;
    }
    return kept_[i] * std::sqrt(dot(own, own)) + std::sqrt(norm_sum_[i] * unload<Dim>(squares).sum());
}

template <int Dim>
double MotionBound<Dim>::operator()(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from,
                                    std::span<const Vector<Dim>> u_to, const BoundaryLoad<Dim>& load_to) {
    parallel_each(static_cast<std::ptrdiff_t>(cells_.size()), [&](std::ptrdiff_t i) {
        store(load_packed<Dim>(u_to[cells_[i]]) - load_packed<Dim>(u_from[cells_[i]]), moved_, i);
    });
    return largest(std::ssize(faces_), [&](std::ptrdiff_t i) {
        const auto face = static_cast<std::size_t>(i);
        if (load_to.displacement.empty()) return of_face(face);
        const auto b = static_cast<std::size_t>(faces_[face]);
        return of_face(face) + (load_to.displacement[b] - load_from.displacement[b]).norm();
    });
}

template class MotionBound<2>;
template class MotionBound<3>;

}  // namespace abut::solid
