#pragma once
#include <cstdint>
#include <vector>

#include "abut/dynamics/memm_async.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {

struct LocalStepOptions {
    int most_levels = 8;     ///< 1 to 20: steps differ by up to 2^(most_levels - 1)
    int contact_margin = 1;  ///< >= 0: levels that cells in contact are finer than they need to be alone, up to the finest
    int contact_levels = 0;  ///< 0 to 10; if > 0: levels that cells in contact are finer than the finest of the others
};

/// Local time steps of a solid: each level takes steps half as long as the one before.
struct SolidLocalSteps {
    dynamics::LocalSteps steps;
    double dt;                        ///< of level 0, stable as `StableStep::dt` is [s]
    std::vector<std::int64_t> cells;  ///< of each level
    std::vector<double> omega_max;  ///< bound of the frequencies of this level, all coarser ones and two layers more [rad/s]
};

/// Sorts the cells into levels by what each could take alone: its own frequency is estimated from a few products with
/// M^-1 K. A power iteration then shows each level (and all that are coarser) stable with its step, and that no motion
/// near its cells resonates with that step; cells that carry an unstable mode, or lie near one that resonates, go to the
/// next finer level, until none is left. A coarsest level with hardly a cell is given up: cells of about one size have one
/// level. Without a margin for cells that contact may reach, contact between cells of different steps can feed the parasitic
/// mode. docs/integrators.md, Local steps.
///
/// Throws BadInput for options out of range (1 to 20 levels, a margin of 0 or more, 0 to 10 levels for contact), and where
/// the power iteration does not settle.
template <int Dim>
[[nodiscard]] SolidLocalSteps local_steps(Solid<Dim>& solid, const dynamics::StableStep& stable,
                                          const LocalStepOptions& options = {});

}  // namespace abut::solid
