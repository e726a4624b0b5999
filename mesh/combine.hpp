#pragma once
#include <vector>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// `combine` of meshes that go: each is freed as soon as the whole has it, so that hardly more than the whole is there at
/// any time.
template <int Dim>
[[nodiscard]] Mesh<Dim> combine(std::vector<Mesh<Dim>>&& meshes);

}  // namespace abut::mesh
