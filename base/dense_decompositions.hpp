#pragma once
#include <Eigen/Core>

/// The decompositions of base/decompositions.hpp for matrices of any size.
namespace abut {

/// Eigenvalues of a symmetric matrix, the least first, and its orthonormal eigenvectors as columns.
struct DenseEigen {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors;
};
[[nodiscard]] DenseEigen symmetric_eigen(const Eigen::MatrixXd& matrix);

/// Pseudo-inverse of a symmetric matrix without negative eigenvalues. Those up to `cut` times the largest count as 0, as
/// does the inverse in their directions.
[[nodiscard]] Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& matrix, double cut);

}  // namespace abut
