#include "abut/solid/cells/finite_cell.hpp"

#include <algorithm>
#include <cmath>

namespace abut::solid {
namespace {

constexpr double least_square = 1e-6;  // under a root, so that a cell that has collapsed gives numbers until it is refused

constexpr double least_normal_square = 0.05;  // r^2 of a free face; it is lost where the plane is stretched by 1.8 of 1.83

Vector<2> quarter_turn(const Vector<2>& v) { return {-v[1], v[0]}; }

template <int Dim>
double sum_of_squares(const Matrix<Dim>& y) {
    return y.template leftCols<Dim - 1>().squaredNorm();
}

double stretch(double contraction, const Matrix<3>& y) {
    return std::sqrt(std::max(least_square, 1.0 + contraction * (2.0 - sum_of_squares<3>(y))));
}

/// e_1 along y_1, e_3 normal to both tangents.
Matrix<3> frame_of(const Matrix<3>& y) {
    const Vector<3> e_1 = y.col(0).normalized();
    const Vector<3> e_3 = y.col(0).cross(y.col(1)).normalized();
    return Matrix<3>::from_columns(e_1, e_3.cross(e_1), e_3);
}

Vector<3> cross(const Vector<3>& a, const Vector<3>& b) { return moment<3>(a, b); }

}  // namespace

template <int Dim>
Matrix<Dim> condensed_stress(const FreeCell<Dim>& free, double lambda, double mu, const Matrix<Dim>& strain) {
    if (free.has_one_normal()) {
        const Vector<Dim> normal = free.normal();
        const Matrix<Dim> onto_plane = Matrix<Dim>::Identity() - normal * normal.transpose();
        const Matrix<Dim> in_plane = onto_plane * strain * onto_plane;
        return 2.0 * mu * (in_plane + contraction(lambda, mu) * in_plane.trace() * onto_plane);
    }
    if (free.n_tangents == 0) return Matrix<Dim>::Zero();
    const double young = mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
    const Vector<Dim> along = free.axes.col(0);
    return young * along.dot(strain * along) * along * along.transpose();
}

template <int Dim>
double normal_stretch_squared(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g) {
    const Matrix<Dim> y = free.axes + g * free.axes;
    return 1.0 + contraction * (Dim - 1 - sum_of_squares<Dim>(y));
}

template <int Dim>
CellStretch cell_stretch(const Matrix<Dim>& g) {
    const Matrix<Dim> strain = 0.5 * (g + g.transpose() + g.transpose() * g);
    return {(Matrix<Dim>::Identity() + g).determinant(), strain.norm()};
}

template <int Dim>
CellStretch condensed_stretch(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g) {
    const Matrix<Dim> f = free.axes + g * free.axes;
    const SmallMatrix<Dim - 1, Dim - 1> metric = f.template leftCols<Dim - 1>().transpose() * f.template leftCols<Dim - 1>();
    const double square = normal_stretch_squared<Dim>(free, contraction, g);
    if (!(square >= least_normal_square)) return {0.0, 0.0};
    const double in_plane = 0.5 * (metric - SmallMatrix<Dim - 1, Dim - 1>::Identity()).norm();
    return {std::sqrt(square * metric.determinant()), std::hypot(in_plane, 0.5 * (square - 1.0))};
}

template <int Dim>
CondensedStep<Dim>::CondensedStep(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g,
                                  const Matrix<Dim>& change)
    : axes_(free.axes) {
    const Matrix<Dim> mean = free.axes + g * free.axes;
    const Matrix<Dim> half = 0.5 * change * free.axes;
    y_ = mean;
    change_ = 2.0 * half.col(0);
    if constexpr (Dim == 2)
        set_plane(contraction, mean - half, mean + half);
    else
        set_space(contraction, mean - half, mean + half);
    mean_ = g + (z_ - mean.col(Dim - 1)) * free.normal().transpose();
}

/// z = ratio R90 y with ratio^2 = (1 + nu')/y.y - nu'.
template <>
void CondensedStep<2>::set_plane(double contraction, const Matrix<2>& y_0, const Matrix<2>& y_1) {
    const double q_0 = y_0.col(0).squaredNorm(), q_1 = y_1.col(0).squaredNorm();
    const auto ratio = [&](double q) { return std::sqrt(std::max(least_square, (1.0 + contraction) / q - contraction)); };
    const double at_0 = ratio(q_0), at_1 = ratio(q_1);
    ratio_ = 0.5 * (at_0 + at_1);
    ratio_slope_ = -(1.0 + contraction) / (q_0 * q_1 * (at_0 + at_1));
    z_ = 0.5 * (at_0 * quarter_turn(y_0.col(0)) + at_1 * quarter_turn(y_1.col(0)));
}

/// Delta e_k = omega x (mean e_k), L omega = -(e_2.Delta y_1, e_3.Delta y_1, e_3.Delta y_2).
template <>
void CondensedStep<3>::set_space(double contraction, const Matrix<3>& y_0, const Matrix<3>& y_1) {
    const Matrix<3> frame_0 = frame_of(y_0), frame_1 = frame_of(y_1);
    const double at_0 = stretch(contraction, y_0), at_1 = stretch(contraction, y_1);
    frame_ = 0.5 * (frame_0 + frame_1);
    contraction_over_stretch_ = contraction / (0.5 * (at_0 + at_1));
    z_ = 0.5 * (at_0 * frame_0.col(2) + at_1 * frame_1.col(2));
    const Vector<3> e_2 = frame_.col(1), e_3 = frame_.col(2);
    const Vector<3> change_1 = y_1.col(0) - y_0.col(0), change_2 = y_1.col(1) - y_0.col(1);
    const auto transposed =
        Matrix<3>::from_columns(cross(e_2, y_.col(0)), cross(e_3, y_.col(0)), cross(e_3, y_.col(1)));  // L^T
    to_angles_ = -transposed.inverse();
    const Vector<3> omega = to_angles_.transpose() * Vector<3>(e_2.dot(change_1), e_3.dot(change_1), e_3.dot(change_2));
    stretch_arm_ = e_3 - 0.25 * cross(omega, cross(omega, e_3));
}

template <int Dim>
Matrix<Dim> CondensedStep<Dim>::pull_back(const Matrix<Dim>& gradient) const {
    const Matrix<Dim> on_axes = gradient * axes_;
    const Vector<Dim> p = on_axes.col(Dim - 1);
    Matrix<Dim> result = on_axes;
    result.col(Dim - 1).setZero();
    if constexpr (Dim == 2) {
        const Vector<2> y = y_.col(0), turned = quarter_turn(y);
        result.col(0) += -ratio_ * quarter_turn(p) +
                         ratio_slope_ * (2.0 * p.dot(turned) * y - 0.5 * change_.dot(p) * quarter_turn(change_));
    } else {
        const Vector<3> angles = to_angles_ * cross(z_, p);
        const double along = contraction_over_stretch_ * p.dot(stretch_arm_);
        result.col(0) += angles[0] * frame_.col(1) + angles[1] * frame_.col(2) - along * y_.col(0);
        result.col(1) += angles[2] * frame_.col(2) - along * y_.col(1);
    }
    return result * axes_.transpose();
}

#define ABUT_INSTANTIATE(Dim)                                                                             \
    template Matrix<Dim> condensed_stress<Dim>(const FreeCell<Dim>&, double, double, const Matrix<Dim>&); \
    template double normal_stretch_squared<Dim>(const FreeCell<Dim>&, double, const Matrix<Dim>&);        \
    template CellStretch cell_stretch<Dim>(const Matrix<Dim>&);                                           \
    template CellStretch condensed_stretch<Dim>(const FreeCell<Dim>&, double, const Matrix<Dim>&);        \
    template class CondensedStep<Dim>;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
