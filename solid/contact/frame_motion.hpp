#pragma once
// Private to the sources of this layer.
#include "abut/base/vector.hpp"

namespace abut::solid {

/// The largest stretch by a difference of two rotations, which is sqrt(1/2) of its Frobenius norm; a little more, for
/// rounding.
template <int Dim>
[[nodiscard]] double turned_by(const Matrix<Dim>& difference) {
    return 0.70710679 * difference.norm();
}

}  // namespace abut::solid
