#pragma once

namespace abut::solid {

/// How the operators of the cells are applied: to round-off the same.
enum class CellForm {
    automatic,  ///< in bodies of simplices that of simplices, which is faster
    general,    ///< that of cells of any shape, for comparison
};

}  // namespace abut::solid
