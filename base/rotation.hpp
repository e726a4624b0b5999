#pragma once
#include <cmath>

#include "abut/base/vector.hpp"

namespace abut {

/// Turns the plane by an angle [rad], from x to y.
[[nodiscard]] inline Matrix<2> rotation_in_plane(double angle) {
    const double sine = std::sin(angle), cosine = std::cos(angle);
    return {{cosine, -sine}, {sine, cosine}};
}

/// Turns space by an angle [rad] about an axis of unit length, by the right-hand rule.
[[nodiscard]] inline Matrix<3> rotation_about(const Vector<3>& axis, double angle) {
    const double cosine = std::cos(angle);
    const Vector<3> s = std::sin(angle) * axis, c = (1.0 - cosine) * axis;
    const double xy = c.x() * axis.y(), xz = c.x() * axis.z(), yz = c.y() * axis.z();
    return {{c.x() * axis.x() + cosine, xy - s.z(), xz + s.y()},
            {xy + s.z(), c.y() * axis.y() + cosine, yz - s.x()},
            {xz - s.y(), yz + s.x(), c.z() * axis.z() + cosine}};
}

/// The rotation through the least angle that turns one direction into the other.
[[nodiscard]] Matrix<3> rotation_between(const Vector<3>& from, const Vector<3>& to);

/// The rotation Q for which Q^T B is symmetric and its trace largest; for B = F M with a positive M the nearest one to F.
[[nodiscard]] Matrix<2> nearest_rotation(const Matrix<2>& b);
[[nodiscard]] Matrix<3> nearest_rotation(const Matrix<3>& b);

/// The axis times the angle, 0 to pi, of a rotation [rad].
[[nodiscard]] Vector<3> rotation_vector(const Matrix<3>& rotation);

}  // namespace abut
