#pragma once
#include <vector>

#include "abut/dynamics/particles.hpp"
#include "studies/orders/known_motions.hpp"

namespace abut::studies::orders {

/// A small system whose motion is known. Errors are the root mean square over its runs.
template <class Law>
struct Problem {
    dynamics::Particles<Law> system;
    std::vector<Run> runs;
    double time;   ///< [s]
    double gauge;  ///< c of bilbao, which keeps V + c > 0 [J]
    int n_bonds;
    int fewest_forces;  ///< of the longest step
    bool is_smooth;     ///< each scheme shows its order
};

// Of known_motions.hpp
[[nodiscard]] Problem<dynamics::LineSpring> duffing();
[[nodiscard]] Problem<dynamics::Attraction> kepler();
[[nodiscard]] Problem<dynamics::LineSpring> chain();
/// From 40 heights of 1 + 0.013 j to t = 12.
[[nodiscard]] Problem<dynamics::LineSpring> bounce();
/// A bell that runs through a bar of 200 cells of size 1 with speed 1 to t = 120, against the exact wave: what a mesh leaves
/// of a higher order in time.
[[nodiscard]] Problem<dynamics::LineSpring> bar();

}  // namespace abut::studies::orders
