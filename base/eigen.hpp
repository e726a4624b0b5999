#pragma once
#include <Eigen/Core>

#include "abut/base/small_matrix.hpp"

/// Our matrices as Eigen's, for its decompositions and its matrices of any size. The other direction needs nothing: an
/// expression of Eigen converts to a SmallMatrix of its shape.
namespace abut {

template <int Rows, int Cols>
using EigenMatrix = Eigen::Matrix<double, Rows, Cols, (Rows == 1 && Cols > 1 ? Eigen::RowMajor : Eigen::ColMajor)>;

/// A view, valid as long as the matrix is.
template <int Rows, int Cols>
[[nodiscard]] Eigen::Map<const EigenMatrix<Rows, Cols>> as_eigen(const SmallMatrix<Rows, Cols>& matrix) {
    return Eigen::Map<const EigenMatrix<Rows, Cols>>(matrix.data());
}
template <int Rows, int Cols>
[[nodiscard]] Eigen::Map<EigenMatrix<Rows, Cols>> as_eigen(SmallMatrix<Rows, Cols>& matrix) {
    return Eigen::Map<EigenMatrix<Rows, Cols>>(matrix.data());
}

}  // namespace abut
