#include "abut/dynamics/stable_step.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "abut/dynamics/power_iteration.hpp"
#include "abut/geometry/messages.hpp"

namespace abut::dynamics {
namespace {

inline constexpr double contact_margin = 0.85;

}  // namespace

template <int Dim>
StableStep stable_step(Solid<Dim>& solid) {
    const HighestMode mode = highest_mode(solid);
    if (!(mode.change <= settled_change) || !(mode.quotient > 0.0))
        throw std::runtime_error("stable step: the power iteration has not settled after " +
                                 std::to_string(mode.iterations) + " iterations (relative change " + number(mode.change) +
                                 ", allowed " + number(settled_change) +
                                 "). Check the mesh for slivers and the material for extreme values.");
    const double omega = bound_of(mode);
    return {omega, stable_step_of(solid, omega), mode.iterations, mode.change};
}

template <int Dim>
double stable_step_of(const Solid<Dim>& solid, double omega) {
    return (solid.contact() ? contact_margin : 1.0) * 2.0 / omega;
}

template StableStep stable_step<2>(Solid<2>&);
template StableStep stable_step<3>(Solid<3>&);
template double stable_step_of<2>(const Solid<2>&, double);
template double stable_step_of<3>(const Solid<3>&, double);

}  // namespace abut::dynamics
