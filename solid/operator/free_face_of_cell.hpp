#pragma once
// Private to the sources of this layer.
#include "abut/base/vector.hpp"

namespace abut::solid {

/// A boundary face of a cell, and in which directions it is free.
template <int Dim>
struct FreeFaceOfCell {
    Vector<Dim> normal;     ///< of unit length, out of the cell
    Matrix<Dim> free_part;  ///< projector onto the directions that are not prescribed
};

}  // namespace abut::solid
