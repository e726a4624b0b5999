#pragma once
#include "abut/base/vector.hpp"

namespace abut::contact {

/// Position of a rigid body: a point that is at X at rest is at `turn` X + `offset`.
template <int Dim>
struct Placement {
    Matrix<Dim> turn = Matrix<Dim>::Identity();  ///< a rotation
    Vector<Dim> offset = Vector<Dim>::Zero();    ///< [m]

    [[nodiscard]] Vector<Dim> operator()(const Vector<Dim>& at_rest) const { return turn * at_rest + offset; }
};

}  // namespace abut::contact
