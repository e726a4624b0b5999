#include "abut/solid/contact/acting_law.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "abut/base/error.hpp"
#include "abut/solid/contact/obstacles.hpp"

namespace abut::solid {

template <int Dim>
ContactLaw acting_law(const Bodies<Dim>& bodies) {
    const SolidOptions<Dim>& options = bodies.options();
    const mesh::Mesh<Dim>& mesh = bodies.mesh();
    const bool any_turns = bodies.any_turns() || Obstacles<Dim>(std::span(options.obstacles)).turn();
    if (any_turns && options.law == ContactLaw::reconstruction)
        throw BadInput(
            mesh.name +
            ": a body or an obstacle may turn, and the modified reconstruction knows normals at rest alone. Choose "
            "ContactLaw::pair_potential or ContactLaw::automatic.");
    const auto breaks = [](const Bond& bond) { return std::isfinite(bond.strength); };
    if (std::ranges::any_of(options.bonds, breaks) && options.law == ContactLaw::reconstruction)
        throw BadInput(mesh.name +
                       ": a bond has a strength, and under the modified reconstruction bonds are for ever. Choose "
                       "ContactLaw::pair_potential or ContactLaw::automatic, or leave the strength out.");
    if (!options.interference.empty() && options.law == ContactLaw::reconstruction)
        throw BadInput(
            mesh.name +
            ": bodies overlap at the start on purpose (interference), which the modified reconstruction does not know. "
            "Choose ContactLaw::pair_potential or ContactLaw::automatic.");
    return options.law == ContactLaw::automatic ? ContactLaw::pair_potential : options.law;
}

template ContactLaw acting_law(const Bodies<2>&);
template ContactLaw acting_law(const Bodies<3>&);

}  // namespace abut::solid
