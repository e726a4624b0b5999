#pragma once
// Private to the sources of the layers; not installed.
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "abut/dynamics/mass.hpp"

namespace abut::dynamics {

using Sparse = Eigen::SparseMatrix<double>;

/// An (n, n) matrix from entries within range.
inline Sparse assembled(std::size_t n, std::span<const MatrixEntry> entries) {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(entries.size());
    for (const auto& [row, column, value] : entries) triplets.emplace_back(row, column, value);
    Sparse matrix(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
}

/// Arrays as vectors of Eigen.
inline Eigen::Map<const Eigen::VectorXd> dense(std::span<const double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}
inline Eigen::Map<Eigen::VectorXd> dense(std::span<double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace abut::dynamics
