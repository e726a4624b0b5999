#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "abut/run/values/forward.hpp"

namespace abut::run {

/// The cell that a longitudinal wave crosses fastest, of all bodies that deform: it decides how long a step may be.
struct SlowCell {
    std::int32_t cell;
    double time;       ///< that a wave takes through it, in its narrowest direction about [s]
    double share;      ///< of the median of all cells that deform [-]
    double of_body;    ///< of the median of its body, which has one material [-]
    std::string text;  ///< "cell 12 of body 'left' at (0.5, 1): a wave takes 1e-06 s through it, 0.2 of the median"
};

/// Nothing where all bodies are rigid. `result` has the kinematics that act.
template <int Dim>
[[nodiscard]] std::optional<SlowCell> slow_cell(const Scene<Dim>& scene, const RunResult<Dim>& result);

/// Throws BadInput where that cell takes less than `least_cell_share` of the median of its own body, whose cells may all be
/// small or stiff. A step that the user gives (RunOptions::dt) and local steps (memm_async) are allowed.
template <int Dim>
void require_even_cells(const Scene<Dim>& scene, const RunResult<Dim>& result);

}  // namespace abut::run
