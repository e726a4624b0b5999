#pragma once
// Private to the sources of this layer.
#include <limits>

#include "abut/mesh/mesh.hpp"
#include "abut/solid/ccg/ccg.hpp"

namespace abut::solid {

/// Whether contact cannot displace a boundary face along its normal, since a support prescribes that: to its partners
/// it is a rigid face on the path of the support. One that is prescribed along itself alone gives way as a free one
/// does.
template <int Dim>
[[nodiscard]] bool is_held(const Ccg<Dim>& ccg, BoundaryFace face) {
    return ccg.normal_stiffness(face) == std::numeric_limits<double>::infinity();
}

/// How deep contact may press this face in [m]; 0 where it is held.
template <int Dim>
[[nodiscard]] double contact_depth(const mesh::Mesh<Dim>& mesh, const Ccg<Dim>& ccg, BoundaryFace face) {
    return is_held(ccg, face) ? 0.0 : cell_depth(mesh, mesh_face(mesh, face));
}

}  // namespace abut::solid
