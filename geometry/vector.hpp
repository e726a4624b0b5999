#pragma once
#include <Eigen/Core>
#include <Eigen/LU>  // inverse() and determinant() of small matrices

namespace abut {

/// Point or direction in Dim dimensions. Plain packed doubles without an alignment demand, so that a view of vectors
/// can be laid over any host array of shape (n, Dim).
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1, Eigen::DontAlign>;

/// Second-order tensor, (Dim, Dim).
template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim, Eigen::DontAlign>;

/// A point of the plane (3D) or line (2D) onto which two facing faces are projected.
template <int Dim>
using PlaneVector = Eigen::Matrix<double, Dim - 1, 1, Eigen::DontAlign>;

}  // namespace abut
