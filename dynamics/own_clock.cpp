#include "abut/dynamics/own_clock.hpp"

#include <cmath>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics::detail {

void check_advance(double d) {
    if (!(d > 0.0) || !std::isfinite(d))
        throw BadInput("OwnClock: it should go on by " + number(d) + " s; give a finite time > 0.", {.value = d});
}

void check_clock_time(double time, double node, double next) {
    if (!(time >= node) || !(time < next))
        throw BadInput("OwnClock: the time is " + number(time) + " s, and the step of the integrator lasts from " +
                           number(node) + " to " + number(next) + " s. Restore both from the same state.",
                       {.value = time, .allowed = node});
}

}  // namespace abut::dynamics::detail
