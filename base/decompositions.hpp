#pragma once
#include <span>

#include "abut/base/vector.hpp"

/// Decompositions of Eigen, compiled once: to instantiate one takes longer than to compile most sources that use it.
namespace abut {

/// Eigenvalues of a symmetric matrix of N rows, the least first, and its orthonormal eigenvectors as columns.
template <int N>
struct SymmetricEigen {
    Vector<N> values;
    Matrix<N> vectors;
};

[[nodiscard]] SymmetricEigen<2> symmetric_eigen(const Matrix<2>& matrix);
[[nodiscard]] SymmetricEigen<3> symmetric_eigen(const Matrix<3>& matrix);

/// The eigenvalues of a symmetric matrix alone, the least first.
[[nodiscard]] Vector<2> symmetric_eigenvalues(const Matrix<2>& matrix);
[[nodiscard]] Vector<3> symmetric_eigenvalues(const Matrix<3>& matrix);

/// The largest eigenvalue of a symmetric tridiagonal matrix without negative eigenvalues: its diagonal (n) and what is
/// beside it (n - 1). NaN if a number on the diagonal is.
[[nodiscard]] double largest_eigenvalue(std::span<const double> diagonal, std::span<const double> beside);

/// Pseudo-inverse of a symmetric matrix without negative eigenvalues. Those up to `cut` times the largest count as 0, as
/// does the inverse in their directions.
[[nodiscard]] Matrix<2> pseudo_inverse(const Matrix<2>& matrix, double cut);
[[nodiscard]] Matrix<3> pseudo_inverse(const Matrix<3>& matrix, double cut);

/// A = u diag(values) v^T, the largest of the values first, none negative; u and v orthogonal.
struct SingularValues {
    Matrix<3> u;
    Vector<3> values;
    Matrix<3> v;
};
[[nodiscard]] SingularValues singular_values(const Matrix<3>& matrix);

/// The largest singular value.
[[nodiscard]] double spectral_norm(const Matrix<2>& matrix);
[[nodiscard]] double spectral_norm(const Matrix<3>& matrix);

}  // namespace abut
