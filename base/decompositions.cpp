#include "abut/base/decompositions.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "abut/base/dense_decompositions.hpp"
#include "abut/base/eigen.hpp"

namespace abut {
namespace {

template <int N>
using Square = Eigen::Matrix<double, N, N>;

template <int N>
SymmetricEigen<N> eigen_of(const Matrix<N>& matrix) {
    const Eigen::SelfAdjointEigenSolver<Square<N>> solver(as_eigen(matrix));
    return {.values = solver.eigenvalues(), .vectors = solver.eigenvectors()};
}

template <int N>
Vector<N> eigenvalues_of(const Matrix<N>& matrix) {
    return Eigen::SelfAdjointEigenSolver<Square<N>>(as_eigen(matrix), Eigen::EigenvaluesOnly).eigenvalues();
}

template <int N>
double norm_of(const Matrix<N>& matrix) {
    return Eigen::JacobiSVD<Square<N>>(as_eigen(matrix)).singularValues()[0];
}

}  // namespace

SymmetricEigen<2> symmetric_eigen(const Matrix<2>& matrix) { return eigen_of<2>(matrix); }
SymmetricEigen<3> symmetric_eigen(const Matrix<3>& matrix) { return eigen_of<3>(matrix); }
DenseEigen symmetric_eigen(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
    return {.values = solver.eigenvalues(), .vectors = solver.eigenvectors()};
}

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
    const DenseEigen eigen = symmetric_eigen(matrix);
    const double least = cut * eigen.values.maxCoeff();
    const Eigen::VectorXd inverse = eigen.values.unaryExpr([&](double value) { return value > least ? 1.0 / value : 0.0; });
    return eigen.vectors * inverse.asDiagonal() * eigen.vectors.transpose();
}

Matrix<2> pseudo_inverse(const Matrix<2>& matrix, double cut) {
    return pseudo_inverse(Eigen::MatrixXd(as_eigen(matrix)), cut);
}
Matrix<3> pseudo_inverse(const Matrix<3>& matrix, double cut) {
    return pseudo_inverse(Eigen::MatrixXd(as_eigen(matrix)), cut);
}

SingularValues singular_values(const Matrix<3>& matrix) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(as_eigen(matrix), Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {.u = svd.matrixU(), .values = svd.singularValues(), .v = svd.matrixV()};
}

double spectral_norm(const Matrix<2>& matrix) { return norm_of<2>(matrix); }
double spectral_norm(const Matrix<3>& matrix) { return norm_of<3>(matrix); }

}  // namespace abut
