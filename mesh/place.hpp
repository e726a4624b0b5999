#pragma once
#include "abut/base/vector.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Puts a mesh somewhere else: a point that is at X goes to `turn` X + `offset`. `turn` is a rotation; measures, numbers and
/// groups stay. Throws BadInput if it is none, to 1e-12, or if anything is not finite.
template <int Dim>
void place(Mesh<Dim>& mesh, const Matrix<Dim>& turn, const Vector<Dim>& offset);

}  // namespace abut::mesh
