#include "abut/solid/cells/edge_step.hpp"

#include <cmath>

#include "abut/base/rotation.hpp"

namespace abut::solid {
namespace {

/// The e_k as columns, by F on the axes of the cell.
template <int Dim>
Matrix<Dim> turned_axes(const Matrix<Dim>& f, bool is_edge) {
    if constexpr (Dim == 3) {
        if (is_edge) {
            const Vector<3> along = f.col(0).normalized();
            const Vector<3> across = (f.col(1) - along.dot(f.col(1)) * along).normalized(), beside = along.cross(across);
            // The turn about the edge is that of both normals as they are seen along it.
            const Matrix<2> turn = nearest_rotation(
                Matrix<2>{{across.dot(f.col(1)), across.dot(f.col(2))}, {beside.dot(f.col(1)), beside.dot(f.col(2))}});
            const auto turned = [&](int k) { return turn(0, k) * across + turn(1, k) * beside; };
            return Matrix<3>::from_columns(along, turned(0), turned(1));
        }
    }
    return nearest_rotation(f);
}

/// x^-nu/2 at two squares x of stretches: both values, and their difference over that of x.
struct Contraction {
    double at_0, at_1, slope;
};
Contraction contraction_of(double poisson, double x_0, double x_1) {
    const double power = -0.5 * poisson, at_0 = std::pow(x_0, power), off = (x_1 - x_0) / x_0;
    const double slope = off == 0.0 ? power * at_0 / x_0 : at_0 * std::expm1(power * std::log1p(off)) / (x_1 - x_0);
    return {at_0, at_0 + slope * (x_1 - x_0), slope};
}

/// Factor of r by heat: a direction is held against it, that of an edge by F, in the plane that out of it.
template <int Dim>
double heated(double swelling, double poisson, bool is_edge) {
    return std::pow(swelling, is_edge || Dim == 2 ? 1.0 + poisson : 1.0);
}

/// omega x (omega x e).
template <int Dim>
Vector<Dim> turned_twice(const SmallMatrix<Dim*(Dim - 1) / 2, 1>& omega, const Vector<Dim>& e) {
    if constexpr (Dim == 2)
        return -omega[0] * omega[0] * e;
    else
        return omega.cross(omega.cross(e));
}

}  // namespace

template <int Dim>
EdgeStep<Dim>::EdgeStep(const FreeCell<Dim>& free, double poisson, const std::array<double, 2>& swelling,
                        const Matrix<Dim>& g, const Matrix<Dim>& change)
    : axes_(free.axes), first_(free.n_tangents), f_(free.axes + g * free.axes) {
    const bool is_edge = first_ == 1;
    const Matrix<Dim> change_of_f = change * axes_, f_0 = f_ - 0.5 * change_of_f, f_1 = f_ + 0.5 * change_of_f;
    const Matrix<Dim> turned_0 = turned_axes<Dim>(f_0, is_edge), turned_1 = turned_axes<Dim>(f_1, is_edge);
    set_turning(turned_0, turned_1, change_of_f);

    Contraction beside{1.0, 1.0, 0.0};
    if (is_edge) beside = contraction_of(poisson, f_0.col(0).squaredNorm(), f_1.col(0).squaredNorm());
    const double heat_0 = heated<Dim>(swelling[0], poisson, is_edge), heat_1 = heated<Dim>(swelling[1], poisson, is_edge);
    const double r_0 = heat_0 * beside.at_0, r_1 = heat_1 * beside.at_1;
    stretch_slope_ = 0.5 * (heat_0 + heat_1) * beside.slope;

    condensed_ = f_;
    Matrix<Dim> changed = change_of_f;
    for (int k = first_; k < Dim; ++k) {
        condensed_.col(k) = 0.5 * (r_0 * turned_0.col(k) + r_1 * turned_1.col(k));
        changed.col(k) = r_1 * turned_1.col(k) - r_0 * turned_0.col(k);
        arms_.col(k) = turned_.col(k) - 0.25 * turned_twice<Dim>(omega_, turned_.col(k));
    }
    mean_ = (condensed_ - axes_) * axes_.transpose();
    change_ = changed * axes_.transpose();
}

/// Conditions c hold at both ends: e_2.y = e_3.y = 0 with y = F t at an edge, e_i.F n_j - e_j.F n_i = 0 for two normals.
/// Each is bilinear and no turn of both changes it, so Delta e_k = omega x (mean e_k) with L omega = -c(mean e, Delta F).
template <int Dim>
void EdgeStep<Dim>::set_turning(const Matrix<Dim>& turned_0, const Matrix<Dim>& turned_1, const Matrix<Dim>& change_of_f) {
    turned_ = 0.5 * (turned_0 + turned_1);
    auto transposed = SmallMatrix<n_axial, n_axial>::Zero();  // L^T
    Angles of_change = Angles::Zero();                        // c(mean e, Delta F)
    int row = 0;
    const auto add_condition = [&](const AxialVector<Dim>& l, double changed) {
        for (int k = 0; k < n_axial; ++k) transposed(k, row) = l[k];
        of_change[row++] = changed;
    };
    for (int i = 0; i < first_; ++i)
        for (int j = first_; j < Dim; ++j)
            add_condition(moment<Dim>(turned_.col(j), f_.col(i)), turned_.col(j).dot(change_of_f.col(i)));
    for (int i = first_; i < Dim; ++i)
        for (int j = i + 1; j < Dim; ++j)
            add_condition(moment<Dim>(turned_.col(i), f_.col(j)) - moment<Dim>(turned_.col(j), f_.col(i)),
                          turned_.col(i).dot(change_of_f.col(j)) - turned_.col(j).dot(change_of_f.col(i)));
    to_angles_ = -transposed.inverse();
    omega_ = to_angles_.transpose() * of_change;
}

/// With Delta F_cond n_k = omega x (mean F_cond n_k) + arm_k Delta r.
template <int Dim>
Matrix<Dim> EdgeStep<Dim>::pull_back(const Matrix<Dim>& gradient) const {
    const Matrix<Dim> on_axes = gradient * axes_;
    AxialVector<Dim> turning = AxialVector<Dim>::Zero();
    double across = 0.0;
    for (int k = first_; k < Dim; ++k) {
        turning += moment<Dim>(condensed_.col(k), on_axes.col(k));
        across += arms_.col(k).dot(on_axes.col(k));
    }
    const Angles angles = to_angles_ * turning;
    Matrix<Dim> result = Matrix<Dim>::Zero();
    int row = 0;
    for (int i = 0; i < first_; ++i) {
        result.col(i) = on_axes.col(i) + 2.0 * stretch_slope_ * across * f_.col(i);
        for (int j = first_; j < Dim; ++j) result.col(i) += angles[row++] * turned_.col(j);
    }
    for (int i = first_; i < Dim; ++i)
        for (int j = i + 1; j < Dim; ++j) {
            result.col(j) += angles[row] * turned_.col(i);
            result.col(i) -= angles[row++] * turned_.col(j);
        }
    return result * axes_.transpose();
}

template <int Dim>
Matrix<Dim> edge_gradient(const FreeCell<Dim>& free, double poisson, double swelling, const Matrix<Dim>& g) {
    const bool is_edge = free.n_tangents == 1;
    Matrix<Dim> f = free.axes + g * free.axes;
    const Matrix<Dim> turned = turned_axes<Dim>(f, is_edge);
    double r = heated<Dim>(swelling, poisson, is_edge);
    if (is_edge) r *= std::pow(f.col(0).squaredNorm(), -0.5 * poisson);
    for (int k = free.n_tangents; k < Dim; ++k) f.col(k) = r * turned.col(k);
    return (f - free.axes) * free.axes.transpose();
}

template Matrix<2> edge_gradient<2>(const FreeCell<2>&, double, double, const Matrix<2>&);
template Matrix<3> edge_gradient<3>(const FreeCell<3>&, double, double, const Matrix<3>&);
template class EdgeStep<2>;
template class EdgeStep<3>;

}  // namespace abut::solid
