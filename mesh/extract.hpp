#pragma once
#include <cstdint>
#include <span>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Some bodies of a mesh as a mesh: their cells, faces and groups in the order that they have there. Groups without a face
/// are left out. `bodies` are increasing. Throws BadInput for a body that does not exist, or out of order.
template <int Dim>
[[nodiscard]] Mesh<Dim> extract_bodies(const Mesh<Dim>& mesh, std::span<const std::int32_t> bodies);

}  // namespace abut::mesh
