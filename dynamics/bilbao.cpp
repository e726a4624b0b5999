#include "abut/dynamics/bilbao.hpp"

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics::detail {

void refuse_gauge(double potential, double gauge) {
    throw Diverged("Bilbao scheme: V = " + number(potential) + " J with the gauge c = " + number(gauge) +
                       " J; V + c must stay > 0 J. Raise the gauge.",
                   {.value = potential + gauge, .allowed = 0.0});
}

void refuse_varying_potential() {
    throw BadInput(
        "Bilbao scheme: the potential of this system changes with time (a boundary condition with a history, or an obstacle "
        "that moves), and psi would not follow. Take MEMM or leapfrog.");
}

}  // namespace abut::dynamics::detail
