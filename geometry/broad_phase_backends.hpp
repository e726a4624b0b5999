#pragma once
// Private to the broad-phase sources; not installed.
#include "abut/geometry/broad_phase.hpp"

namespace abut::geometry::backend {

/// Every back end takes non-empty boxes with finite bounds and reports each overlapping pair (closed test, in double) at
/// least once, in any order; pairs within one set have first < second. In 2D the boxes are lifted to 3D with z = 0.
using Boxes = std::span<const Box<3>>;

std::vector<IndexPair> brute_force_pairs(Boxes boxes_1, Boxes boxes_2);
std::vector<IndexPair> brute_force_pairs(Boxes boxes);
std::vector<IndexPair> embree_pairs(Boxes boxes_1, Boxes boxes_2);
std::vector<IndexPair> embree_pairs(Boxes boxes);
std::vector<IndexPair> fcl_pairs(Boxes boxes_1, Boxes boxes_2);
std::vector<IndexPair> fcl_pairs(Boxes boxes);

}  // namespace abut::geometry::backend
