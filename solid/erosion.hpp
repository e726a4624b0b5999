#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

/// Reason for which a cell leaves a run.
enum class LeavingReason : std::uint8_t {
    strain,          ///< ErosionLimits::strain
    plastic_strain,  ///< ErosionLimits::plastic_strain
    stress,          ///< ErosionLimits::stress
    function,        ///< a function of the user chose it
    remnant          ///< what is left around it is too thin to have strains (`remnants`)
};

struct LeavingCell {
    std::int32_t cell;  ///< of the mesh of the solid
    LeavingReason reason;
};

/// Cells that are beyond a limit of SolidOptions::erosion in the state that the last step has evaluated: its middle, and
/// of finite bodies its end. Increasing, each once, with the first reason that holds. To be asked right after a step.
/// Strains are those of CellView::displacement_gradient in the frame of the body, stresses those of CellView::stress,
/// in the plane with the one across it. In elastic and isotropic bodies it looks at cells alone that the step found
/// strained far enough; at all of the others where there is a limit of stress.
template <int Dim>
[[nodiscard]] std::vector<LeavingCell> cells_beyond_limits(const Solid<Dim>& solid);

/// Cells that have too little left around them once the cells `leaving` are gone: the centroids of cells that hang
/// together with one of them by a few faces lie on a line, or in space in a plane. Their displacement could not be
/// reconstructed: cells that are alone, and rows of bricks. Only cells near those that leave are looked at, and none of
/// rigid bodies. Increasing.
template <int Dim>
[[nodiscard]] std::vector<std::int32_t> remnants(const Solid<Dim>& solid, std::span<const std::int32_t> leaving);

}  // namespace abut::solid
