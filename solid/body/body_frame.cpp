#include "abut/solid/body/body_frame.hpp"

#include <cmath>

#include "abut/dynamics/angular_velocity.hpp"

namespace abut::solid {

template <int Dim>
AxialVector<Dim> spin_of(const Matrix<Dim>& second_moment, const AxialVector<Dim>& angular_momentum) {
    dynamics::Inertia<Dim> inertia;
    if constexpr (Dim == 2)
        inertia(0, 0) = second_moment.trace();
    else
        inertia = second_moment.trace() * Matrix<3>::Identity() - second_moment;
    return dynamics::angular_velocity<Dim>(inertia, angular_momentum);
}
template AxialVector<2> spin_of<2>(const Matrix<2>&, const AxialVector<2>&);
template AxialVector<3> spin_of<3>(const Matrix<3>&, const AxialVector<3>&);

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
    turned_ = inverse * axial<Dim>(mean_turn_.transpose() * (end.moment - start.moment));
    const Matrix<Dim> turning = hat<Dim>(turned_);
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
