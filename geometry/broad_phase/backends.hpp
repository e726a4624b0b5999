#pragma once
// Private to the broad-phase sources; not installed.
#include "abut/geometry/broad_phase/found_pairs.hpp"

namespace abut::geometry::backend {

/// Every back end takes non-empty boxes with finite bounds and adds each overlapping pair (closed test, in double) at least
/// once, in any order; pairs within one set have first < second. It may stop once there are too many.
/// In 2D the boxes are lifted to 3D with z = 0.
using Boxes = std::span<const Box<3>>;

extern const bool has_embree, has_fcl;  ///< false: they throw BadInput, since the build had no such library

void find_by_brute_force(Boxes boxes_1, Boxes boxes_2, FoundPairs& found);
void find_by_brute_force(Boxes boxes, FoundPairs& found);
void find_by_embree(Boxes boxes_1, Boxes boxes_2, FoundPairs& found);
void find_by_embree(Boxes boxes, FoundPairs& found);
void find_by_fcl(Boxes boxes_1, Boxes boxes_2, FoundPairs& found);
void find_by_fcl(Boxes boxes, FoundPairs& found);
/// Takes the boxes: it has its own copy of them in its blocks.
void find_by_packed_tree(std::vector<Box<3>> boxes_1, std::vector<Box<3>> boxes_2, bool in_spatial_order, FoundPairs& found);
void find_by_packed_tree(std::vector<Box<3>> boxes, bool in_spatial_order, FoundPairs& found);

}  // namespace abut::geometry::backend
