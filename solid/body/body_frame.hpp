#pragma once
#include "abut/base/vector.hpp"

namespace abut::solid {

/// hat(a) b = a × b.
template <int Dim>
[[nodiscard]] Matrix<Dim> hat(const AxialVector<Dim>& a) {
    if constexpr (Dim == 2)
        return {{0.0, -a[0]}, {a[0], 0.0}};
    else
        return {{0.0, -a[2], a[1]}, {a[2], 0.0, -a[0]}, {-a[1], a[0], 0.0}};
}

/// Twice the axial vector of the skew part: for M = b a^T it is a × b.
template <int Dim>
[[nodiscard]] AxialVector<Dim> axial(const Matrix<Dim>& m) {
    if constexpr (Dim == 2)
        return AxialVector<2>(m(1, 0) - m(0, 1));
    else
        return {m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
}

/// The spin of a body with these second moments sum m x' x'^T that carries an angular momentum; none about axes without
/// inertia.
template <int Dim>
[[nodiscard]] AxialVector<Dim> spin_of(const Matrix<Dim>& second_moment, const AxialVector<Dim>& angular_momentum);

/// Position of a body that turns: the mass mean of its points x, and the rotation that fits best how they lie about it.
/// docs/method.md, Bodies that turn.
template <int Dim>
struct BodyFrame {
    Vector<Dim> centre = Vector<Dim>::Zero();      ///< mass mean of x [m]
    Matrix<Dim> turn = Matrix<Dim>::Identity();    ///< Q = nearest_rotation(B)
    Matrix<Dim> moment = Matrix<Dim>::Identity();  ///< B = sum m (x - centre) (X - mean of X)^T [kg m^2]

    /// Position of a point that lies at w in the frame.
    [[nodiscard]] Vector<Dim> operator()(const Vector<Dim>& w) const { return centre + turn * w; }
};

/// The frame of a body on a straight step of its points: how gradients in the frame become gradients in space, so that the
/// work of a step is exactly the change of energy, and neither momentum nor angular momentum about the mean positions
/// appears. With the same frame at both ends it is the plain gradient. docs/method.md, Bodies that turn.
template <int Dim>
class FrameStep {
public:
    FrameStep() = default;
    FrameStep(const BodyFrame<Dim>& start, const BodyFrame<Dim>& end);

    /// Q_b, the mean of both rotations; not a rotation itself.
    [[nodiscard]] const Matrix<Dim>& mean_turn() const { return mean_turn_; }
    /// Q_p: forces on points of the body, in space, act in the frame by Q_p^T.
    [[nodiscard]] const Matrix<Dim>& force_turn() const { return force_turn_; }
    /// omega: Delta Q = hat(omega) Q_b, the rotation vector of the step [rad], of large ones the tangent of half the
    /// angle twice.
    [[nodiscard]] const AxialVector<Dim>& turned() const { return turned_; }
    /// lambda: a moment T that is missing in space is made up by the gradient m Q_b (lambda × X') of each point [1/s^2].
    [[nodiscard]] AxialVector<Dim> carry(const AxialVector<Dim>& missing_moment) const { return to_carry_ * missing_moment; }

private:
    using AxialMatrix = SmallMatrix<Dim*(Dim - 1) / 2, Dim*(Dim - 1) / 2>;

    Matrix<Dim> mean_turn_ = Matrix<Dim>::Identity();
    Matrix<Dim> force_turn_ = Matrix<Dim>::Identity();
    AxialVector<Dim> turned_ = AxialVector<Dim>::Zero();
    AxialMatrix to_carry_ = AxialMatrix::Zero();  // L^-T
};

/// The angle of a rotation [rad], 0 to pi.
template <int Dim>
[[nodiscard]] double rotation_angle(const Matrix<Dim>& turn);

}  // namespace abut::solid
