#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <string>

#include "abut/base/error.hpp"
#include "abut/solid/kinematics/capabilities.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// Throws BadInput where cells cannot have steps of their own. `contact_makes_parts`: contact, if there is any, can act
/// in parts of a step.
template <int Dim>
void require_local_steps(const std::string& mesh, const SolidOptions<Dim>& options, bool contact_makes_parts) {
    const bool all_can =
        std::ranges::all_of(options.kinematics, [](Kinematics of_body) { return has(of_body, Capability::local_steps); });
    if (all_can && contact_makes_parts) return;
    throw BadInput(
        mesh +
        ": local steps are for bodies of Kinematics::small under the modified reconstruction, without friction: the "
        "frame of a body couples all of its cells, and forces inside a body of Kinematics::finite are not linear. "
        "Take one step for all (memm), or Kinematics::small and ContactLaw::reconstruction.");
}

}  // namespace abut::solid
