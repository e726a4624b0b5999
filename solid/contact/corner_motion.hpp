#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/solid/body/body_frame.hpp"
#include "abut/solid/operator/corner_weights.hpp"

namespace abut::solid {

/// Bounds of how the corners of a boundary face move with the cells around: the largest norms of its corners.
struct CornerRow {
    std::int32_t cell;  ///< behind the face
    std::int32_t body;
    std::int32_t first, last;  ///< cells that move it beside its own, and |W_j|: CornerRows::others, CornerRows::norms
    double norm_sum;           ///< of these norms [-]
    double sum;                ///< CornerWeights::sum
    double missing;            ///< CornerWeights::missing
    double amplification;      ///< how far a corner moves in its frame at most when no cell moves by more than 1 [-]
};

/// Rows of some faces.
class CornerRows {
public:
    /// A face of this cell and body, by the weights of its corners.
    void append_face(std::int32_t cell, std::size_t body, std::span<const CornerWeights> corners);

    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] const CornerRow& operator[](std::int32_t face) const { return rows_[static_cast<std::size_t>(face)]; }
    [[nodiscard]] const std::vector<std::int32_t>& others() const { return others_; }
    [[nodiscard]] const std::vector<double>& norms() const { return norms_; }

private:
    std::vector<CornerRow> rows_;
    std::vector<std::int32_t> others_;
    std::vector<double> norms_;
};

/// How far the corner that moved farthest is from where it was [m].
struct FarthestMotion {
    double in_space = 0.0;
    double in_frame = 0.0;  ///< seen from the frame of its body

    /// False, too, for what is not a number.
    [[nodiscard]] bool is_within(const FarthestMotion& allowed) const {
        return in_space <= allowed.in_space && in_frame <= allowed.in_frame;
    }
};

/// Bounds of how far the corners of some faces are from where they were in one state, while loads are constant: one for each
/// face. From step to step it grows by what no cell and no frame exceeds, and where that is too much it is looked at.
///
/// With the positions x_j of cells and p_j of these in the frame Q of their body, c being that behind the face, a corner is
/// at
///
///     x = x_c + Q (p - p_c),     d(p - p_c) = sum_j W_j d(p_j - p_c) - (I - sum_j W_j) dp_c
///     |dx| <= |dx_c| + |dQ| |x - x_c| + |d(p - p_c)|,     |d(p_j - p_c)| <= |d(x_j - x_c)| + |dQ| |x_j - x_c|
///
/// Neighbours move alike, and |dx_c| is exact: the bound is close. By Cauchy and Schwarz |sum_j W_j d_j|^2 <= sum |W_j| sum
/// |W_j| |d_j|^2.
template <int Dim>
class CornerMotion {
public:
    /// The motion of no face yet. `rest`: positions of the cells [m]. Both must outlive the object.
    CornerMotion(const CornerRows& rows, std::span<const Vector<Dim>> rest) : rows_(&rows), rest_(rest) {}

    /// Begins in q with these frames. `faces`: of the rows (n); `radius`: the distance from the point of its cell of the
    /// corner of each that is farthest from it (n) [m].
    void begin(std::vector<std::int32_t> faces, std::vector<double> radius, std::span<const Vector<Dim>> q,
               std::span<const BodyFrame<Dim>> frames);
    /// Lets each face move that far in space before its bound counts, and takes it off all bounds (n) [m].
    void set_slack(std::vector<double> slack);
    /// Goes on to where the bodies have these frames; no cell moves farther in its frame than `cell_motion` [m], infinity:
    /// not known.
    void advance(std::span<const BodyFrame<Dim>> frames, double cell_motion);
    /// Whether all bounds are small enough, with n operations at most.
    [[nodiscard]] bool is_within(const FarthestMotion& allowed);
    /// Faces whose bounds are not, by their index in `faces`.
    [[nodiscard]] std::vector<std::int32_t> beyond(const FarthestMotion& allowed) const;
    /// Lowers the bounds of some faces to those that their cells give; q and frames are where it has gone to.
    void look(std::span<const std::int32_t> which, std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames);
    /// Sets the motion of the farthest corner in space of a face, which is known [m].
    void set_in_space(std::int32_t i, double motion) { in_space_[i] = motion - slack_[i] - since_start(i); }
    /// Bound of all faces for any q with these frames; changes no bound.
    [[nodiscard]] FarthestMotion until(std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames) const;

private:
    [[nodiscard]] double stretched(std::int32_t i) const { return amplifications_[i] * travelled_; }
    [[nodiscard]] double since_start(std::int32_t i) const { return path_[body_[i]] + stretched(i); }
    [[nodiscard]] FarthestMotion bound(std::int32_t i) const {
        return {in_space_[i] + since_start(i), in_frame_[i] + stretched(i)};
    }
    void advance_paths(std::span<const BodyFrame<Dim>> frames, double deformed);
    [[nodiscard]] FarthestMotion bound_of_all() const;
    [[nodiscard]] Vector<Dim> in_frame(const CornerRow& row, std::span<const Vector<Dim>> q,
                                       std::span<const BodyFrame<Dim>> frames) const;
    [[nodiscard]] FarthestMotion of_face(std::int32_t i, std::span<const Vector<Dim>> q,
                                         std::span<const BodyFrame<Dim>> frames) const;

    const CornerRows* rows_;
    std::span<const Vector<Dim>> rest_;
    std::vector<std::int32_t> faces_;     // of the rows (n)
    std::vector<std::int32_t> body_;      // (n)
    std::vector<double> amplifications_;  // (n)
    double amplification_ = 0.0;          // the largest

    std::vector<double> slack_;  // (n) [m]

    // Where it began
    std::vector<Vector<Dim>> q_;
    std::vector<Vector<Dim>> p_;   // of the cell of each face, in its frame (n)
    std::vector<double> arm_;      // |x - x_c|, largest (n) [m]
    std::vector<double> arm_sum_;  // sum_j |W_j| |x_j - x_c| (n) [m]
    std::vector<Matrix<Dim>> turn_;
    std::vector<double> radius_;  // of the corners about the centre of each body [m]

    // Bounds: those of the faces when they were looked at, less what was below since the start by then
    std::vector<double> in_space_, in_frame_;  // (n)
    double travelled_ = 0.0;                   // sum of the motions of cells
    std::vector<double> path_;                 // of the corner of each body that moves farthest with its frame
    std::vector<BodyFrame<Dim>> frames_;       // now
    double fastest_path_ = 0.0;                // sum of the largest steps of these
    FarthestMotion farthest_;                  // of all faces, with these sums:
    double farthest_travelled_ = 0.0;
    double farthest_path_ = 0.0;
};

}  // namespace abut::solid
