#include "abut/dynamics/step_options.hpp"

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::dynamics {

void require_stable(const std::string& what, double dt, double stable_dt, const std::string& remedy) {
    if (dt <= stable_dt) return;
    throw BadInput(what + " is " + number(dt) + " s, above the stable step of " + number(stable_dt) +
                       " s, from which on vibrations grow. " + remedy,
                   {.value = dt, .allowed = stable_dt});
}

const OptionList<StepOptions>& step_options() {
    using Of = StepOptions;
    static const OptionList<StepOptions> options = {
        option("cfl", &Of::cfl,
               {.help = "time step over the stable step, at most 1 (the margin for contact is in the stable step)",
                .limits = {.above = 0.0,
                           .below = 1.0,
                           .closed = true,
                           .remedy = "Give a time step above the stable one with --dt and --allow-unstable."},
                .named = Named::never,
                .depth = OptionDepth::everyday}),
        option("dt", &Of::dt,
               {.help = "time step, refused above the stable step; by default cfl decides",
                .limits = {.unit = "s", .above = 0.0},
                .named = Named::never,
                .depth = OptionDepth::everyday}),
        option("restart", &Of::restart,
               {.help = "of memm: steps between neutral restarts, which clear the parasitic mode of whole bodies; 0: none",
                .by_default = "10 and the filter with friction, 50 where a body is finite, else 0",
                .schemes = {"memm"}})};
    return options;
}

}  // namespace abut::dynamics
