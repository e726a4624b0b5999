#pragma once
#include <algorithm>
#include <span>

#include "abut/mesh/part.hpp"
#include "abut/solid/options.hpp"

namespace abut::solid {

/// How many layers of neighbours a solid on several ranks needs around the cells of a rank (mesh::part_of), for bodies of these
/// kinematics; none: all are `small`. Free faces of bodies of Kinematics::finite depend on the stress behind them, one layer
/// farther. The solid checks them where it is made: stencils near a slot may need more.
[[nodiscard]] inline int copy_layers(std::span<const Kinematics> kinematics) {
    return mesh::default_layers + (std::ranges::find(kinematics, Kinematics::finite) == kinematics.end() ? 0 : 1);
}

}  // namespace abut::solid
