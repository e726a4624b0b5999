#pragma once
#include <cstdint>
#include <vector>

#include "abut/dynamics/memm_async.hpp"
#include "abut/dynamics/stable_step.hpp"

namespace abut::solid {

template <int Dim>
class Solid;

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
    /// Per level [rad/s]: a bound of the frequencies of its cells, all coarser ones and two layers more, and, over
    /// sqrt(2), of those of five layers more; the same part of what the step of each level allows, for it is shown for all
    /// together. Of the finest that of the whole.
    std::vector<double> omega_max;
};

/// Sorts the cells into levels by what each could take alone: its own frequency is estimated from a few products with
/// M^-1 K. One search for the highest mode, every cell with the longest step that it has to bear, then shows all levels
/// stable with their steps, and that no motion near their cells resonates with a step; cells about a place where a mode is
/// not allowed go to the next finer level, until none is left. A coarsest level with hardly a cell is given up: cells of
/// about one size have one level. Without a margin for cells that contact may reach, contact between cells of different
/// steps can feed the parasitic mode. docs/integrators.md, Local steps.
///
/// Throws BadInput for options out of range (1 to 20 levels, a margin of 0 or more, 0 to 10 levels for contact), and where
/// the search does not settle.
template <int Dim>
[[nodiscard]] SolidLocalSteps local_steps(Solid<Dim>& solid, const dynamics::StableStep& stable,
                                          const LocalStepOptions& options = {});

}  // namespace abut::solid
