#pragma once
// Private to the sources of the layers.
#include <array>
#include <cstdint>

#include "abut/geometry/overlap/overlap.hpp"

namespace abut::geometry {

/// Pairs of triangles a and b in their common plane, one pair per column; all counter-clockwise. Both areas come out with
/// the error that plain clipping has if b is the smaller triangle and lies near the origin.
struct TriangleBatch {
    static constexpr int size = 64;
    using Row = std::array<double, size>;

    alignas(64) std::array<Row, 3> x_a, y_a, x_b, y_b;  ///< [m]
    /// The size of what was added to a in double arithmetic [m]. 0: the coordinates are those to decide on.
    alignas(64) Row rounded_shift;
};

struct AreaBatch {
    alignas(64) TriangleBatch::Row area;  ///< 0 where the triangles share none, else no less than the smallest normal
    alignas(64) std::array<TriangleBatch::Row, 2> area_gradient;  ///< for b shifted against a
    std::uint64_t undecided = 0;  ///< bit k: doubles cannot answer for pair k, whose numbers above mean nothing
};

/// A_12 and dA/ds of `overlap_area` for the first n columns, as far as doubles decide them for sure. Where a corner is
/// within 8e-12 of the extent of the pair of the line of an edge, its side is found from the end of the edge that is
/// nearer, if need be with twice the digits: corners that coincide except for rounding, and most that lie on edges
/// except for rounding, are decided here. Not decided are pairs whose coordinates were rounded before (`rounded_shift`)
/// and that have such a corner, thin, tiny or huge faces, and corners nearer to a line than 1e-31 that neither have the
/// place of an end of the edge nor are above or beside it along an axis. The answer for a pair does not depend on its
/// column or on the others. Columns that fill up the last register must hold numbers, too.
[[nodiscard]] AreaBatch overlap_areas(const TriangleBatch& triangles, int n);

/// `overlap_area` of one pair by the method `fast`, for what the batch leaves undecided. Adds the pair to `counts`.
/// Throws BadInput for numbers that are not finite, which the batch never decides on.
[[nodiscard]] OverlapArea<3> counted_overlap_area(ProjectedFace<3> face_1, ProjectedFace<3> face_2,
                                                  const PlaneVector<3>& shift, DecisionCounts& counts);

}  // namespace abut::geometry
