#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "abut/mesh/mesh.hpp"
#include "abut/mesh/part.hpp"

namespace abut::mesh {

// Meshes as bytes, on their way to another process: all of their members, to the last bit.

template <int Dim>
[[nodiscard]] std::vector<std::byte> bytes_of(const Mesh<Dim>& mesh);
template <int Dim>
[[nodiscard]] std::vector<std::byte> bytes_of(const MeshPart<Dim>& part);

/// Mesh that these bytes are of. Throws BadInput for bytes of something else, or that are damaged.
template <int Dim>
[[nodiscard]] Mesh<Dim> mesh_in(std::span<const std::byte> bytes);
/// Part of a mesh that these bytes are of. Throws BadInput for bytes of something else, or that are damaged.
template <int Dim>
[[nodiscard]] MeshPart<Dim> part_in(std::span<const std::byte> bytes);

}  // namespace abut::mesh
