#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/health/face_faults.hpp"
#include "abut/geometry/health/face_soup.hpp"

namespace abut::geometry {

/// Pairs (i, j), i < j, of usable faces that meet in more than the corners or the edge they share: they cross, touch, or are
/// folded onto each other. Sorted, complete. Decided exactly on the coordinates as given; a polygon stands for the triangles
/// it is cut into (geometry/triangulate.hpp), whose common corners and edges count as shared. Corners at exactly one
/// position are shared whatever their index. Two faces with the same three corners, one turned round, are not listed here.
/// `merged_vertices` is merged_vertices(soup.vertices), `faults` is face_faults(soup). Throws SearchLimitError for more than
/// SearchLimits::pairs pairs of boxes; nothing for bad faces.
[[nodiscard]] std::vector<IndexPair> self_intersections(const FaceSoup& soup, std::span<const std::int32_t> merged_vertices,
                                                        std::span<const FaceFault> faults);

}  // namespace abut::geometry
