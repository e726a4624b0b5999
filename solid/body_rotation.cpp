#include "abut/solid/body_rotation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

#include "abut/solid/body_cells.hpp"
#include "abut/solid/kinematics/body_frame.hpp"

namespace abut::solid {
namespace {

/// Of a symmetric matrix; directions in which it has next to nothing are left out: the cells lie in a line or a plane.
template <int Dim>
Matrix<Dim> pseudo_inverse(const Matrix<Dim>& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    const double cut = 1e-12 * eigen.eigenvalues().maxCoeff();
    const Eigen::VectorXd inverse =
        eigen.eigenvalues().unaryExpr([&](double value) { return value > cut ? 1.0 / value : 0.0; });
    return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

template <int Dim>
BodyRotation<Dim>::BodyRotation(const mesh::Mesh<Dim>& mesh, std::span<const double> masses) : mesh_(mesh), masses_(masses) {
    for (std::int32_t body = 0; body < mesh.n_bodies(); ++body) {
        const auto [begin, end] = cells_of_body(mesh, body);
        Body& added = bodies_.emplace_back(begin, end, Vector<Dim>::Zero(), Matrix<Dim>::Zero());
        double mass = 0.0;
        for (std::int32_t c = added.begin; c < added.end; ++c) {
            mass += masses[c];
            added.centre += masses[c] * mesh.cell_centroid[c];
        }
        added.centre /= mass;
        Matrix<Dim> second_moment = Matrix<Dim>::Zero();
        for (std::int32_t c = added.begin; c < added.end; ++c) {
            const Vector<Dim> arm = mesh.cell_centroid[c] - added.centre;
            second_moment += masses[c] * (arm * arm.transpose());
        }
        added.inverse = pseudo_inverse<Dim>(second_moment);
    }
}

template <int Dim>
std::vector<double> BodyRotation<Dim>::angles(std::span<const Vector<Dim>> u) const {
    std::vector<double> angles;
    for (const Body& body : bodies_) {
        Matrix<Dim> moment = Matrix<Dim>::Zero();  // sum m u (x - centre)^T
        for (std::int32_t c = body.begin; c < body.end; ++c)
            moment += (masses_[c] * u[c]) * (mesh_.cell_centroid[c] - body.centre).transpose();
        angles.push_back(rotation_angle<Dim>(nearest_rotation<Dim>(Matrix<Dim>::Identity() + moment * body.inverse)));
    }
    return angles;
}

template class BodyRotation<2>;
template class BodyRotation<3>;

}  // namespace abut::solid
