#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/solid/operator/arrays.hpp"
#include "abut/solid/operator/corner_weights.hpp"
#include "abut/solid/operator/lanes.hpp"
#include "abut/solid/operator/operator_values.hpp"

namespace abut::solid {

/// How far boundary faces have moved at most between two states. With D the deficit of a row of weights W_j and c the cell
/// of the face,
///
///     dû_f = (1 - D) du_c + sum_j W_j (du_j - du_c) + what the loads have changed
///
/// and by Cauchy and Schwarz |sum_j W_j d_j|^2 <= sum |W_j| sum |W_j| |d_j|^2: a norm is read instead of each W_j.
/// Neighbours move alike, so the bound is close.
template <int Dim>
class MotionBound {
public:
    /// Bound for these boundary faces, increasing. The arrays must outlive it.
    MotionBound(const CcgArrays<Dim>& arrays, std::span<const BoundaryFace> faces);

    [[nodiscard]] double operator()(std::span<const Vector<Dim>> u_from, const BoundaryLoad<Dim>& load_from,
                                    std::span<const Vector<Dim>> u_to, const BoundaryLoad<Dim>& load_to);

    /// Under constant loads the bound grows by at most this times the motion of the cell that moves farthest: the largest
    /// |1 - D| + 2 sum_j |W_j|, j other cells than c [-]. The bound is a seminorm of du.
    [[nodiscard]] double amplification() const { return amplification_; }

    /// Weights of F (dû_f + dG_c arm): the point of a face at `arm` from its centroid that tilts with the cell, `free` being
    /// the projector F on the directions in which it does.
    [[nodiscard]] CornerWeights corner_weights(BoundaryFace face, const Vector<Dim>& arm, const Matrix<Dim>& free) const;

private:
    [[nodiscard]] double of_face(std::size_t i) const;

    const CcgArrays<Dim>& arrays_;
    std::vector<BoundaryFace> faces_;
    std::vector<std::int32_t> cells_;      // all that one of the faces depends on, and their own, increasing
    std::vector<std::int32_t> own_;        // position in cells_ of the face's cell (n)
    std::vector<double> kept_;             // |1 - D| (n)
    std::vector<std::int32_t> offsets_;    // of a row, by weight (n + 1)
    std::vector<std::int32_t> positions_;  // in cells_, by weight
    std::vector<double> norms_;            // |W_j|, by weight; 0 for the face's own cell
    std::vector<double> norm_sum_;         // of a row (n)
    double amplification_ = 0.0;
    LargeArray<double> moved_;  // du of cells_, registers
};

}  // namespace abut::solid
