#include "abut/dynamics/stable_step.hpp"

#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics::detail {

void require_settled(const HighestMode& mode) {
    if (!(mode.change <= settled_change) || !(mode.quotient > 0.0))
        throw BadInput("stable step: the search for the highest mode has not settled after " +
                           std::to_string(mode.iterations) + " iterations (relative change " + number(mode.change) +
                           ", allowed " + number(settled_change) +
                           "). Check the mesh for slivers and the material for extreme values.",
                       {.value = mode.change, .allowed = settled_change});
}

}  // namespace abut::dynamics::detail
