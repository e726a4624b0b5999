#include "abut/solid/step_of_breaking.hpp"

#include <cmath>
#include <utility>

#include "abut/solid/solid.hpp"

namespace abut::solid {

template <int Dim>
dynamics::StableStep step_of_breaking(Solid<Dim>& solid) {
    const dynamics::StableStep together = dynamics::stable_step(solid);
    SolidOptions<Dim> options = solid.options();
    if (std::erase_if(options.bonds, [](const Bond& bond) { return std::isfinite(bond.strength); }) == 0) return together;
    Solid<Dim> apart(solid.mesh(), std::move(options), solid.ranks());
    const dynamics::StableStep of_parts = dynamics::stable_step(apart);
    return of_parts.dt < together.dt ? of_parts : together;
}

template dynamics::StableStep step_of_breaking(Solid<2>&);
template dynamics::StableStep step_of_breaking(Solid<3>&);

}  // namespace abut::solid
