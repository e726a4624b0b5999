#include "abut/solid/kinematics/body_frame.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

namespace abut::solid {
namespace {

constexpr double no_inertia = 1e-12;  // about an axis, over the largest

}  // namespace

template <>
AxialVector<2> spin_of<2>(const Matrix<2>& second_moment, const AxialVector<2>& angular_momentum) {
    const double inertia = second_moment.trace();
    return inertia > 0.0 ? AxialVector<2>(angular_momentum / inertia) : AxialVector<2>(AxialVector<2>::Zero());
}

template <>
AxialVector<3> spin_of<3>(const Matrix<3>& second_moment, const AxialVector<3>& angular_momentum) {
    const Eigen::Matrix3d inertia = second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(inertia);
    const double cut = no_inertia * eigen.eigenvalues().maxCoeff();
    const Eigen::Vector3d inverse =
        eigen.eigenvalues().unaryExpr([&](double value) { return value > cut ? 1.0 / value : 0.0; });
    return eigen.eigenvectors() * inverse.cwiseProduct(eigen.eigenvectors().transpose() * angular_momentum);
}

template <>
Matrix<2> nearest_rotation<2>(const Matrix<2>& b) {
    const double cosine = b(0, 0) + b(1, 1), sine = b(1, 0) - b(0, 1);
    const double length = std::hypot(cosine, sine);
    Matrix<2> turn;
    turn << cosine, -sine, sine, cosine;
    return turn / length;
}

template <>
Matrix<3> nearest_rotation<3>(const Matrix<3>& b) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(b, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
    return u * svd.matrixV().transpose();
}

/// omega is defined by Delta Q = hat(omega) Q_b: the change of Q^T B is symmetric in between as it is at both ends, which
/// gives L omega = axial(Q_b^T Delta B) with the columns axial(Q_b^T hat(e_j) B_b) of L.
template <int Dim>
FrameStep<Dim>::FrameStep(const BodyFrame<Dim>& start, const BodyFrame<Dim>& end)
    : mean_turn_(0.5 * (start.turn + end.turn)) {
    const Matrix<Dim> mean_moment = 0.5 * (start.moment + end.moment);
    AxialMatrix l;
    for (int j = 0; j < l.cols(); ++j)
        l.col(j) = axial<Dim>(mean_turn_.transpose() * hat<Dim>(AxialVector<Dim>::Unit(j)) * mean_moment);
    const AxialMatrix inverse = l.inverse();
    const AxialVector<Dim> omega = inverse * axial<Dim>(mean_turn_.transpose() * (end.moment - start.moment));
    const Matrix<Dim> turning = hat<Dim>(omega);
    force_turn_ = mean_turn_ - 0.25 * turning * turning * mean_turn_;
    to_carry_ = inverse.transpose();
}

template <>
double rotation_angle<2>(const Matrix<2>& turn) {
    return std::abs(std::atan2(turn(1, 0) - turn(0, 1), turn.trace()));
}

template <>
double rotation_angle<3>(const Matrix<3>& turn) {
    return std::atan2(axial<3>(turn).norm(), turn.trace() - 1.0);
}

template class FrameStep<2>;
template class FrameStep<3>;

}  // namespace abut::solid
