#pragma once
#include <vector>

#include "studies/trade/problems.hpp"

namespace abut::studies::trade {

/// Two discs or cylinders that slip over each other, and hardly turn. `cells`: in the radius, coarse to fine;
/// `reference`: of the runs that errors are measured against.
[[nodiscard]] Problem slip_problem(int dim, std::vector<int> cells, int reference);
/// Two discs that spin, have turned by about 1 and 0.3 rad when they touch, and then slip over each other.
[[nodiscard]] Problem turn_problem(std::vector<int> cells, int reference);

}  // namespace abut::studies::trade
