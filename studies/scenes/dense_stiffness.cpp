#include "studies/scenes/dense_stiffness.hpp"

#include <vector>

namespace abut::studies {

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

template Eigen::MatrixXd dense_stiffness(solid::Solid<2>&);
template Eigen::MatrixXd dense_stiffness(solid::Solid<3>&);

}  // namespace abut::studies
