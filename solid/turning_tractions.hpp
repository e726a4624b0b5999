#pragma once
// Private to the sources of this layer.
#include <vector>

#include "abut/dynamics/ranks.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/options.hpp"

namespace abut::solid {

/// Whether each traction of the options acts on bodies that may turn (n_tractions). A call of all ranks, of which one may have
/// no face of its group. Throws BadInput for a group on bodies of both kinds, and for one that the mesh does not have.
template <int Dim>
[[nodiscard]] std::vector<bool> turning_tractions(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                                  const dynamics::Ranks* ranks);

}  // namespace abut::solid
