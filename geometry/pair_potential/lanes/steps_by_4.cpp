#include "abut/geometry/pair_potential/lanes/lane_steps.hpp"

namespace abut::geometry::lanes {

void integrate_by_4(LaneTask<2>* tasks, int n, Integral integral) { integrate<Lanes<4>>(tasks, n, integral); }
void integrate_by_4(LaneTask<3>* tasks, int n, Integral integral) { integrate<Lanes<4>>(tasks, n, integral); }

}  // namespace abut::geometry::lanes
