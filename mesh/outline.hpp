#pragma once
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Names of the bodies and groups of a mesh, and its report, without cells and faces: enough of the whole for a rank that
/// has its part.
template <int Dim>
[[nodiscard]] Mesh<Dim> outline_of(const Mesh<Dim>& mesh);

}  // namespace abut::mesh
