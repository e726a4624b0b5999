#pragma once
#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "abut/solid/solid.hpp"

namespace abut::test {

/// K, column by column.
template <int Dim>
Eigen::MatrixXd dense_stiffness(solid::Solid<Dim>& solid) {
    const auto n = static_cast<Eigen::Index>(solid.size());
    Eigen::MatrixXd k(n, n);
    std::vector<double> unit(solid.size(), 0.0), column(solid.size());
    for (Eigen::Index j = 0; j < n; ++j) {
        unit[static_cast<std::size_t>(j)] = 1.0;
        solid.stiffness_product(unit, column);
        k.col(j) = Eigen::Map<const Eigen::VectorXd>(column.data(), n);
        unit[static_cast<std::size_t>(j)] = 0.0;
    }
    return k;
}

/// omega_max of the dense eigenvalue problem K x = omega^2 M x.
template <int Dim>
double highest_frequency(solid::Solid<Dim>& solid) {
    const auto n = static_cast<Eigen::Index>(solid.size());
    const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(solid.inverse_mass().data(), n).cwiseSqrt();
    const Eigen::MatrixXd k = root.asDiagonal() * dense_stiffness(solid) * root.asDiagonal();
    return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues()[n - 1]);
}

}  // namespace abut::test
