#include "abut/base/rotation.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "abut/base/decompositions.hpp"
#include "abut/base/eigen.hpp"

namespace abut {

Matrix<3> rotation_between(const Vector<3>& from, const Vector<3>& to) {
    // As Eigen::Quaterniond::FromTwoVectors, except for the axis of opposite vectors: its decomposition is one more to
    // compile.
    const Vector<3> start = from.normalized(), end = to.normalized();
    const double cosine = end.dot(start);
    Eigen::Quaterniond turn;
    if (cosine < -1.0 + 1e-12) {
        const Matrix<3> both{{start.x(), start.y(), start.z()}, {end.x(), end.y(), end.z()}, {0.0, 0.0, 0.0}};
        const double squared = 0.5 * (1.0 + std::max(cosine, -1.0));
        turn.w() = std::sqrt(squared);
        turn.vec() = as_eigen(std::sqrt(1.0 - squared) * singular_values(both).v.col(2));
    } else {
        const double twice_w = std::sqrt((1.0 + cosine) * 2.0), over_twice_w = 1.0 / twice_w;
        turn.vec() = as_eigen(start.cross(end) * over_twice_w);
        turn.w() = twice_w * 0.5;
    }
    return turn.toRotationMatrix();
}

Matrix<2> nearest_rotation(const Matrix<2>& b) {
    const double cosine = b(0, 0) + b(1, 1), sine = b(1, 0) - b(0, 1);
    const double length = std::hypot(cosine, sine);
    return Matrix<2>{{cosine, -sine}, {sine, cosine}} / length;
}

Matrix<3> nearest_rotation(const Matrix<3>& b) {
    auto [u, values, v] = singular_values(b);
    if ((u * v.transpose()).determinant() < 0.0) u.col(2) *= -1.0;
    return u * v.transpose();
}

Vector<3> rotation_vector(const Matrix<3>& rotation) {
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(as_eigen(rotation)));
    return turn.angle() * Vector<3>(turn.axis());
}

}  // namespace abut
