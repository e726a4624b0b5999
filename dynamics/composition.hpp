#pragma once
#include <cstddef>
#include <vector>

#include "abut/dynamics/path_mean.hpp"

namespace abut::dynamics {

/// Compositions of MEMM's sub-flows A and B. docs/integrators.md, Higher orders.
enum class Composition {
    strang,         ///< order 2, 3 forces per step: A B A
    suzuki_4,       ///< order 4, 15 forces: five whole steps A B A, for any discrete gradient
    blanes_moan_4,  ///< order 4, 13 forces
    blanes_moan_6,  ///< order 6, 21 forces
};

/// "blanes_moan_4"
[[nodiscard]] const char* name_of(Composition composition);
[[nodiscard]] int order_of(Composition composition);

/// A part of a step: one copy of the momentum carries q along a straight path, and the other one is kicked.
struct SubFlow {
    bool kicks_a;   ///< A; otherwise B
    double length;  ///< over the step [-]; some are < 0
};

/// The parts of a step, in order; their lengths add up to 1, those of A and of B to 1/2 each. Coefficients: S. Blanes and
/// P. C. Moan, J. Comput. Appl. Math. 142 (2002), methods S6 and S10; M. Suzuki, Phys. Lett. A 146 (1990).
[[nodiscard]] std::vector<SubFlow> sub_flows(Composition composition);

/// Whether `mean_force` of a system is the integral of F along the path, as its `mean_is_exact()` says; false where it does
/// not say so. Any other discrete gradient has H~ exact as well, but an order above 2 in compositions of whole steps only.
template <System S>
[[nodiscard]] bool mean_is_exact(const S& system) {
    if constexpr (requires { system.mean_is_exact(); })
        return system.mean_is_exact();
    else
        return false;
}

namespace detail {
/// Throws BadInput for a mean with which the composition would lose its order.
void check_composition_mean(Composition composition, PathMean mean, bool system_is_exact);
/// Throws BadInput unless it is 0 or that of q.
void check_rigid(std::size_t size, std::size_t size_of_q);
/// Throws Misuse unless it is `strang`.
void check_synchronised(Composition composition);
/// Throws BadInput: `what` is the reason, in the words of the user.
[[noreturn]] void refuse_composed(const char* what);
}  // namespace detail

}  // namespace abut::dynamics
