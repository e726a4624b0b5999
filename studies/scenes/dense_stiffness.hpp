#pragma once
#include <Eigen/Core>

#include "abut/solid/solid.hpp"

namespace abut::studies {

/// K [N/m], column by column, as the solver applies it: symmetric up to rounding. For small meshes, up to some thousand
/// unknowns; the eigenvalues of K ask for its symmetric part.
template <int Dim>
[[nodiscard]] Eigen::MatrixXd dense_stiffness(solid::Solid<Dim>& solid);

}  // namespace abut::studies
