#pragma once
#include <vector>

#include "abut/dynamics/particles.hpp"

namespace abut::studies::orders {

/// A start, and q and p at the end, exact or by far finer steps of another scheme.
struct Run {
    std::vector<double> q, p;
    std::vector<double> end_q, end_p;
};

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

/// V = q^2/2 + q^4/4 from 1.5 at rest to t = 20.
[[nodiscard]] Problem<dynamics::LineSpring> duffing();
/// A planet on an ellipse of half-axis 1 and eccentricity 0.5, V = -1/|q|, from its pericentre to t = 20.
[[nodiscard]] Problem<dynamics::Attraction> kepler();
/// 16 unit masses with fixed ends, springs of force r + r^2/4 + r^3, from half a sine of 1.5 at rest to t = 40.
[[nodiscard]] Problem<dynamics::LineSpring> chain();
/// A unit mass under gravity 1 on a wall of stiffness 400, from 40 heights of 1 + 0.013 j at rest to t = 12.
[[nodiscard]] Problem<dynamics::LineSpring> bounce();
/// A bell that runs through a bar of 200 cells of size 1 with speed 1 to t = 120, against the exact wave: what a mesh leaves
/// of a higher order in time.
[[nodiscard]] Problem<dynamics::LineSpring> bar();

}  // namespace abut::studies::orders
