#include "abut/base/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace abut {
namespace {

template <int N>
using Square = Eigen::Matrix<double, N, N>;

template <int N>
SymmetricEigen<N> eigen_of(const Square<N>& matrix) {
    const Eigen::SelfAdjointEigenSolver<Square<N>> solver(matrix);
    return {.values = solver.eigenvalues(), .vectors = solver.eigenvectors()};
}

template <int N>
Vector<N> eigenvalues_of(const Square<N>& matrix) {
    return Eigen::SelfAdjointEigenSolver<Square<N>>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

template <int N>
double norm_of(const Square<N>& matrix) {
    return Eigen::JacobiSVD<Square<N>>(matrix).singularValues()[0];
}

}  // namespace

SymmetricEigen<2> symmetric_eigen(const Matrix<2>& matrix) { return eigen_of<2>(matrix); }
SymmetricEigen<3> symmetric_eigen(const Matrix<3>& matrix) { return eigen_of<3>(matrix); }
SymmetricEigen<Eigen::Dynamic> symmetric_eigen(const Eigen::MatrixXd& matrix) { return eigen_of<Eigen::Dynamic>(matrix); }

Vector<2> symmetric_eigenvalues(const Matrix<2>& matrix) { return eigenvalues_of<2>(matrix); }
Vector<3> symmetric_eigenvalues(const Matrix<3>& matrix) { return eigenvalues_of<3>(matrix); }

double largest_eigenvalue(std::span<const double> diagonal, std::span<const double> beside) {
    const auto vector_of = [](std::span<const double> values) {
        return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    };
    // Eigen drops a number b beside the diagonal where (b/epsilon)^2 <= |a_i| + |a_i+1|, which depends on the unit: so the
    // largest number on the diagonal is 1.
    const double unit = vector_of(diagonal).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (!(unit > 0.0)) return unit;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(vector_of(diagonal) / unit, vector_of(beside) / unit, Eigen::EigenvaluesOnly);
    return unit * solver.eigenvalues().maxCoeff();
}

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix, double cut) {
    const SymmetricEigen<Eigen::Dynamic> eigen = symmetric_eigen(matrix);
    const double least = cut * eigen.values.maxCoeff();
    const Eigen::VectorXd inverse = eigen.values.unaryExpr([&](double value) { return value > least ? 1.0 / value : 0.0; });
    return eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
}

SingularValues singular_values(const Matrix<3>& matrix) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {.u = svd.matrixU(), .values = svd.singularValues(), .v = svd.matrixV()};
}

Matrix<3> rotation_between(const Vector<3>& from, const Vector<3>& to) {
    // As Eigen::Quaterniond::FromTwoVectors, except for the axis of opposite vectors: its decomposition is one more to
    // compile.
    const Vector<3> start = from.normalized(), end = to.normalized();
    const double cosine = end.dot(start);
    Eigen::Quaterniond turn;
    if (cosine < -1.0 + 1e-12) {
        Matrix<3> both = Matrix<3>::Zero();
        both.row(0) = start;
        both.row(1) = end;
        const double squared = 0.5 * (1.0 + std::max(cosine, -1.0));
        turn.w() = std::sqrt(squared);
        turn.vec() = std::sqrt(1.0 - squared) * singular_values(both).v.col(2);
    } else {
        const double twice_w = std::sqrt((1.0 + cosine) * 2.0), over_twice_w = 1.0 / twice_w;
        turn.vec() = start.cross(end) * over_twice_w;
        turn.w() = twice_w * 0.5;
    }
    return turn.toRotationMatrix();
}

double spectral_norm(const Matrix<2>& matrix) { return norm_of<2>(matrix); }
double spectral_norm(const Matrix<3>& matrix) { return norm_of<3>(matrix); }

}  // namespace abut
