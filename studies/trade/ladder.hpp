#pragma once
#include <string>
#include <vector>

#include "apps/support/run_options.hpp"

namespace abut::studies::trade {

/// A point of the ladder, as it would be typed: "--overlap frozen --events off"; "" for the defaults.
using Setting = std::string;

/// Which settings are run.
enum class Extent {
    each,      ///< each choice by itself, all others at their defaults, and the presets
    products,  ///< also all combinations of overlap x events x quadrature x time step, and of filter x time step
};

/// All different, the defaults first. Of a problem at rest only what matters at rest.
[[nodiscard]] std::vector<Setting> ladder(Extent extent, bool at_rest);

}  // namespace abut::studies::trade
