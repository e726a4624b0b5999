#include "abut/solid/step_of_breaking.hpp"

#include "abut/solid/bond_view.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
dynamics::StableStep step_of_breaking(Solid<Dim>& solid) {
    const dynamics::StableStep together = dynamics::stable_step(solid);
    if (!solid.bonds().may_break()) return together;
    Solid<Dim> broken(solid.mesh(), solid.options(), solid.ranks());
    broken.break_bonds();
    const dynamics::StableStep of_parts = dynamics::stable_step(broken);
    return of_parts.dt < together.dt ? of_parts : together;
}

template dynamics::StableStep step_of_breaking(Solid<2>&);
template dynamics::StableStep step_of_breaking(Solid<3>&);

}  // namespace abut::solid
