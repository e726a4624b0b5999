#pragma once
#include <array>

#include "abut/base/vector.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"
#include "abut/geometry/tangents.hpp"

namespace abut::geometry {

/// How the faces of a pair move past each other along a step, and what a force between them does to their corners.
/// docs/friction.md.
///
/// One material point of each face is followed: that which lies at the common point x_c, half way between the points at
/// which the faces press. Where a face would have to be continued by more than a quarter of its least height, x_c is
/// nearer to that face. The motion is a linear function of those of the corners, with coefficients of the mid positions
/// X = (x_0 + x_1)/2. A motion dx = V + omega x X of both faces together moves both points alike: the slip of a
/// rotation of any angle is zero. Forces are the transpose of that function: they have no sum, no moment about X, and
/// do the work force . motion().
///
/// No pair slips by more than its corners move past each other. Needles that are pressed in deeper than they are wide
/// would: the function is then scaled down, and its forces with it (`is_clipped`).
template <int Dim>
class PairSlip {
public:
    /// `pressure`: weights of the corners, of any scale, >= 0 and not all 0 on either face.
    PairSlip(const PairCorners<Dim>& x_0, const PairCorners<Dim>& x_1, const PairPressure<Dim>& pressure);

    [[nodiscard]] const Vector<Dim>& point() const { return point_; }    ///< x_c [m]
    [[nodiscard]] const Vector<Dim>& normal() const { return normal_; }  ///< n at X, from face 1 to face 2
    /// Motion of the point of face 2 less that of the point of face 1 [m].
    [[nodiscard]] const Vector<Dim>& motion() const { return motion_; }
    /// Tangents of the plane across n that turn with a face (0 or 1): its own, turned by the shortest rotation that
    /// takes its normal to n or -n.
    [[nodiscard]] Tangents<Dim> tangents(int face) const;
    /// Whether motion and forces are scaled down.
    [[nodiscard]] bool is_clipped() const { return scale_ < 1.0; }
    /// `force` on face 2, scaled as forces on corners are [N].
    [[nodiscard]] Vector<Dim> scaled(const Vector<Dim>& force) const { return scale_ * force; }
    /// Forces on the corners for `force` on face 2 and the opposite on face 1, scaled [N].
    [[nodiscard]] PairCorners<Dim> on_corners(const Vector<Dim>& force) const;

private:
    struct Side {
        std::array<Vector<Dim>, Dim> corner;  // X
        std::array<Vector<Dim>, Dim> motion;  // x_1 - x_0
        Vector<Dim> normal;
        std::array<Vector<Dim>, Dim> slope;  // of the shape function of each corner, along the face
        std::array<double, Dim> share;       // of the motion of each corner in that of the point, where the face translates
        double height;                       // of x_c over the face
        double steepest;                     // of the slopes, squared: 1/(least height of the face)^2
    };

    static void find_slopes(Side& side);
    [[nodiscard]] Vector<Dim> continued_motion() const;
    [[nodiscard]] double cut_to_corners(const Vector<Dim>& motion) const;

    std::array<Side, 2> side_;
    Vector<Dim> point_;
    Vector<Dim> normal_;
    Vector<Dim> motion_;
    double scale_;
};

}  // namespace abut::geometry
