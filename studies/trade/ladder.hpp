#pragma once
#include <string>
#include <vector>

#include "apps/support/run_options.hpp"

namespace abut::studies::trade {

/// A point of the ladder, as it would be typed: "--overlap frozen --events off"; "" for the defaults.
using Setting = std::string;

/// Which settings are run.
enum class Extent {
    each,        ///< each choice by itself, all others at their defaults, and the presets
    kinematics,  ///< kinematics, laws of contact and presets alone
    products,    ///< also all combinations of overlap x events x quadrature x time step, and of filter x time step
};

/// How the bodies of a problem move.
enum class Motion {
    at_rest,      ///< solved by statics: no scheme in time, no drift
    translating,  ///< small bodies are right
    turning,      ///< they are not: bodies float where no setting says otherwise
};

/// All different, the defaults first. Of a problem at rest only what matters at rest; of bodies that turn only what bodies
/// that float can be asked, and the other kinematics.
[[nodiscard]] std::vector<Setting> ladder(Extent extent, Motion motion);

}  // namespace abut::studies::trade
