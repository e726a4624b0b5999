#pragma once
#include <limits>
#include <string>

#include "abut/base/option.hpp"

namespace abut::dynamics {

/// How long a step is, and what clears the parasitic mode, wherever a run may be made: programs, scenes, Python, C.
struct StepOptions {
    double cfl = 0.9;                                      ///< time step over the stable step [-]
    double dt = std::numeric_limits<double>::quiet_NaN();  ///< time step [s], instead of `cfl`
    int restart = 0;                                       ///< steps between neutral restarts; 0: none
};

/// Throws BadInput for a step above the stable one: "dt is 2 s, above the stable step of 1 s, from which on vibrations
/// grow", with `what` in the place of dt and `remedy` behind.
void require_stable(const std::string& what, double dt, double stable_dt, const std::string& remedy);

[[nodiscard]] const OptionList<StepOptions>& step_options();

}  // namespace abut::dynamics
