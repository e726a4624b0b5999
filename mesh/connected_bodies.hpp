#pragma once
// Private to the layer; not installed.
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Gives every connected component (cells linked by common vertices) of the cells whose body is -1 a body of its own,
/// "body_1", "body_2", ... in the order of their first cells. Names that a body has already are left out.
template <int Dim>
void name_connected_bodies(CellSoup<Dim>& soup);

}  // namespace abut::mesh
