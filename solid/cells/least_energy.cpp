#include "abut/solid/cells/least_energy.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "abut/base/eigen.hpp"

namespace abut::solid {
namespace {

constexpr int most_steps = 40, most_halvings = 30;
constexpr double last_step = 1e-8;     // of F: Newton's next one is below rounding
constexpr double first_square = 0.05;  // of the stretch across that the search begins with

/// Right-handed: along what the first tangent has become, and normal to what all have. Beside a single tangent in space
/// the second axis is in the plane of it and of the first normal as affine faces carry it.
template <int Dim>
Matrix<Dim> principal_frame_of(const Matrix<Dim>& y, bool has_one_normal) {
    const Vector<Dim> along = y.col(0).normalized();
    if constexpr (Dim == 2) {
        return Matrix<2>::from_columns(along, Vector<2>(-along[1], along[0]));
    } else if (has_one_normal) {
        const Vector<3> normal = y.col(0).cross(y.col(1)).normalized();
        return Matrix<3>::from_columns(along, normal.cross(along), normal);
    } else {
        const Vector<3> across = (y.col(1) - along.dot(y.col(1)) * along).normalized();
        return Matrix<3>::from_columns(along, across, along.cross(across));
    }
}

}  // namespace

template <int Dim>
Matrix<Dim> LeastEnergy<Dim>::linear_shape(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g) {
    const Matrix<Dim> y = free.axes + g * free.axes;
    double square = 1.0 + contraction * free.n_tangents;
    for (int k = 0; k < free.n_tangents; ++k) square -= contraction * y.col(k).squaredNorm();
    return std::sqrt(std::max(first_square, square)) * Matrix<Dim>::Identity();
}

/// As the linear material has F A^-1, in plane strain with its stretch out of the plane.
template <int Dim>
Matrix<Dim> LeastEnergy<Dim>::warm_shape(const FreeCell<Dim>& free, double contraction, const Matrix<Dim>& g,
                                         const ThermalStretch& stretch) {
    const Matrix<3> elastic = Matrix<3>::Identity() + stretch.elastic_gradient<Dim>(g);
    const Matrix<Dim> y = elastic.template topLeftCorner<Dim, Dim>() * free.axes;
    double square = 1.0 + contraction * free.n_tangents;
    for (int k = 0; k < free.n_tangents; ++k) square -= contraction * y.col(k).squaredNorm();
    if (Dim == 2) square += contraction * (1.0 - elastic(2, 2) * elastic(2, 2));
    const Matrix<Dim> warm = stretch.tensor().template topLeftCorner<Dim, Dim>();
    return std::sqrt(std::max(first_square, square)) * free.axes.transpose() * warm * free.axes;
}

template <int Dim>
LeastEnergy<Dim>::LeastEnergy(const FreeCell<Dim>& free, const StoredEnergy<Dim>& law, const Matrix<Dim>& g,
                              const Matrix<Dim>& shape)
    : law_(&law), axes_(free.axes), gradient_(g) {
    if (free.n_tangents == 0) return;
    frame_ = principal_frame_of<Dim>(axes_ + g * axes_, free.has_one_normal());
    if (free.has_one_normal())
        set_one_normal(g, shape);
    else
        set_edge(shape);
}

/// Minimises W over F + sum a_k D_k. Steps that do not lower it are halved.
template <int Dim>
template <int n>
void LeastEnergy<Dim>::minimise(std::array<Matrix<Dim>, n> directions) {
    using Unknowns = SmallMatrix<n, 1>;
    std::array<Matrix<Dim>, n> changes;
    response_ = law_->at(gradient_);
    for (int step = 0; step < most_steps; ++step) {
        Unknowns residual;
        SmallMatrix<n, n> tangent;
        law_->stress_changes(gradient_, directions, changes);
        for (int l = 0; l < n; ++l) {
            for (int k = 0; k < n; ++k) tangent(k, l) = directions[k].cwiseProduct(changes[l]).sum();
            residual[l] = directions[l].cwiseProduct(response_.stress).sum();
        }
        const Unknowns a = -Unknowns(as_eigen(tangent).ldlt().solve(as_eigen(residual)));
        Matrix<Dim> change = Matrix<Dim>::Zero();
        for (int k = 0; k < n; ++k) change += a[k] * directions[k];
        const bool is_last = change.norm() <= last_step;
        Response<Dim> next = law_->at(gradient_ + change);
        for (int i = 0; i < most_halvings && !is_last && !(next.energy <= response_.energy); ++i) {
            change *= 0.5;
            next = law_->at(gradient_ + change);
        }
        gradient_ += change;
        response_ = next;
        if (is_last) return;
    }
    response_.energy = std::numeric_limits<double>::quiet_NaN();
    response_.stress.setConstant(response_.energy);
}

template <int Dim>
void LeastEnergy<Dim>::set_one_normal(const Matrix<Dim>& g, const Matrix<Dim>& shape) {
    const Vector<Dim> normal = axes_.col(Dim - 1);
    gradient_ += (frame_ * shape.col(Dim - 1) - normal - g * normal) * normal.transpose();
    std::array<Matrix<Dim>, Dim> directions;
    for (int k = 0; k < Dim; ++k) directions[k] = Vector<Dim>::Unit(k) * normal.transpose();
    minimise<Dim>(directions);
    std::array<Matrix<Dim>, Dim> changes;
    law_->stress_changes(gradient_, directions, changes);
    Matrix<Dim> tangent;
    for (int k = 0; k < Dim; ++k) tangent.col(k) = changes[k] * normal;
    inverse_ = tangent.inverse();
}

/// Two normals in space: what is left is a bar along the edge. A turn about it costs nothing and is left out: n_1 stays
/// in the plane of the bar and of where it was.
template <int Dim>
void LeastEnergy<Dim>::set_edge(const Matrix<Dim>& shape) {
    if constexpr (Dim == 3) {
        Matrix<3> wanted = axes_ + gradient_ * axes_;
        for (int k = 1; k < 3; ++k) wanted.col(k) = frame_ * shape.col(k);
        gradient_ = (wanted - axes_) * axes_.transpose();
        const Vector<3> along = frame_.col(0), u = frame_.col(1), v = frame_.col(2), n_1 = axes_.col(1), n_2 = axes_.col(2);
        minimise<5>({along * n_1.transpose(), u * n_1.transpose(), along * n_2.transpose(), u * n_2.transpose(),
                     v * n_2.transpose()});
    }
}

template <int Dim>
Matrix<Dim> LeastEnergy<Dim>::pull_back(const Matrix<Dim>& gradient) const {
    const Vector<Dim> normal = axes_.col(Dim - 1);
    const Vector<Dim> z = inverse_ * (gradient * normal);
    const Matrix<Dim> tangent = gradient - law_->stress_change(gradient_, z * normal.transpose());
    return tangent - (tangent * normal) * normal.transpose();
}

template class LeastEnergy<2>;
template class LeastEnergy<3>;

}  // namespace abut::solid
