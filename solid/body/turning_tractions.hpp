#pragma once
// Private to the sources of this layer.
#include <vector>

#include "abut/dynamics/ranks.hpp"
#include "abut/mesh/mesh.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// Places where a traction acts.
enum class TractionHold {
    cells,   ///< on faces of bodies that do not turn, which give way to it
    frames,  ///< the same in the frames of floating bodies, with which it turns; on rigid ones of its group at points
    points,  ///< at places that move with points of bodies that may turn; the faces take it as free
};

/// Hold of each traction of the options (n_tractions). A call of all ranks, of which one may have no face of its group.
/// Throws BadInput for a group on bodies of Kinematics::small and on others, and for one that the mesh does not have.
template <int Dim>
[[nodiscard]] std::vector<TractionHold> traction_holds(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                                       const dynamics::Ranks& ranks);

}  // namespace abut::solid
