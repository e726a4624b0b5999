#pragma once

#include "abut/base/vector.hpp"

namespace abut::geometry {

/// Orthonormal coordinates on the plane (3D) or line (2D) orthogonal to a unit normal. A function of the normal alone.
/// 3D: tangent 0 x tangent 1 = normal, so a polygon that runs counter-clockwise about the normal is counter-clockwise in
/// the plane; one whose own normal is opposite comes out clockwise and must be reversed.
/// 2D: the tangent is the normal turned by +90 degrees, so a segment (a, b) with this normal (see polygon.hpp) comes out in
/// increasing order; one with the opposite normal must be reversed.
template <int Dim>
class PlaneFrame {
public:
    /// `normal` must be of unit length.
    explicit PlaneFrame(const Vector<Dim>& normal) : normal_(normal), tangents_(tangents_of(normal)) {}

    [[nodiscard]] const Vector<Dim>& normal() const { return normal_; }
    /// Shape (Dim, Dim - 1), one tangent per column.
    [[nodiscard]] const SmallMatrix<Dim, Dim - 1>& tangents() const { return tangents_; }
    [[nodiscard]] PlaneVector<Dim> project(const Vector<Dim>& point) const { return tangents_.transpose() * point; }
    /// The vector of space, orthogonal to the normal, that projects to `in_plane`.
    [[nodiscard]] Vector<Dim> lift(const PlaneVector<Dim>& in_plane) const { return tangents_ * in_plane; }

private:
    static SmallMatrix<Dim, Dim - 1> tangents_of(const Vector<Dim>& normal) {
        SmallMatrix<Dim, Dim - 1> tangents;
        if constexpr (Dim == 2) {
            tangents = {-normal.y(), normal.x()};
        } else {
            std::ptrdiff_t axis;  // the axis farthest from the normal
            normal.cwiseAbs().minCoeff(&axis);
            tangents.col(0) = Vector<3>::Unit(axis).cross(normal).normalized();
            tangents.col(1) = normal.cross(tangents.col(0));
        }
        return tangents;
    }

    Vector<Dim> normal_;
    SmallMatrix<Dim, Dim - 1> tangents_;
};

}  // namespace abut::geometry
