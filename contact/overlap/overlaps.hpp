#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/geometry/overlap/overlap.hpp"

namespace abut::contact {

/// The patch that two facing faces share, seen along their common normal.
/// Law: swapping faces 1 and 2 reverses `normal` and `area_gradient` and changes nothing else (beyond rounding), unless both
/// faces are rigid: the normal is then that of face 2.
template <int Dim>
struct Overlap {
    std::int32_t face_1;  ///< index into the surface
    std::int32_t face_2;
    double area;                ///< A_12 [m^(Dim-1)], > 0
    Vector<Dim> normal;         ///< n_12, unit, from face 1's body into face 2's: docs/method.md, The normal of a pair
    double gap;                 ///< g [m], between the centroids along the normal; > 0 apart
    Vector<Dim> area_gradient;  ///< dA/ds [m^(Dim-2)], orthogonal to the normal: what A gains as face 2 moves
};

/// Outcome for the pairs: not_facing + decided.total() = pairs.
struct OverlapReport {
    std::int64_t pairs = 0;
    std::int64_t overlaps = 0;
    std::int64_t not_facing = 0;       ///< n_1 . n_2 >= 0: no common normal to look along, so no overlap
    geometry::DecisionCounts decided;  ///< on the others; pairs that are not two triangles go the scalar way (3D)
};

template <int Dim>
struct Overlaps {
    std::vector<Overlap<Dim>> found;  ///< in the order of the pairs
    OverlapReport report;
};

/// The narrow phase: of every pair of faces that faces each other, displaced, the overlap; pairs that share no area give
/// none. Corners are projected in double arithmetic; whether the projected faces overlap is then decided exactly, by both
/// methods. Faces that match to the last digit, displaced by the same or along an axis, meet in corners and edges to the
/// last digit also in projection. The same bits for any number of threads, compiled for any x86-64 processor.
/// `displacement` has one vector per face [m]. `surface` must be one that `check` lets pass. Throws BadInput for arrays
/// whose sizes disagree and for a pair that names a face that does not exist, Diverged naming the face if one that a pair
/// names has a displacement that is not finite.
template <int Dim>
[[nodiscard]] Overlaps<Dim> find_overlaps(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement,
                                          std::span<const geometry::IndexPair> pairs,
                                          geometry::AreaMethod method = geometry::AreaMethod::fast);

/// As above, into memory that is used again, for a host that asks at every step: what was in `overlaps` is lost.
template <int Dim>
void find_overlaps(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement,
                   std::span<const geometry::IndexPair> pairs, geometry::AreaMethod method, Overlaps<Dim>& overlaps);

/// The shared patch of one pair itself, for pictures: its corners in space, on the plane halfway between the displaced
/// centroids, counter-clockwise about n_12 (3D), or its two ends (2D). Empty where the faces share no area or do not face
/// each other. The decision is exact, the corners are rounded. Errors as above.
template <int Dim>
[[nodiscard]] std::vector<Vector<Dim>> overlap_polygon(const SurfaceView<Dim>& surface,
                                                       std::span<const Vector<Dim>> displacement, geometry::IndexPair pair);

/// Polygons of many pairs: pairs[i] gives patch i. Sizes are checked once, so that a pair costs the same on large surfaces.
template <int Dim>
[[nodiscard]] std::vector<std::vector<Vector<Dim>>> overlap_polygons(const SurfaceView<Dim>& surface,
                                                                     std::span<const Vector<Dim>> displacement,
                                                                     std::span<const geometry::IndexPair> pairs);

/// The narrow phase of faces that turn and deform: `surface` is that at rest, which `check` must have let pass, and `x`
/// (n_vertices) [m] where its vertices are now. Centroids, normals and areas of the faces that pairs name are those of now.
/// The same decisions and the same bits as of a surface rebuilt from `x`; the work is that of the pairs and of the faces
/// they name, beside one light pass over all faces. A face that has lost its area has no normal and shares nothing:
/// `not_facing` counts its pairs. A polygon that is no longer flat is seen as its projection along the normal of the pair,
/// its own normal being Newell's: area and gap are then right to first order in the warp; triangles and segments stay flat.
/// Throws BadInput as `find_overlaps`, Diverged naming the face if a vertex of one that a pair names is not finite, if its
/// area is not, or if it is a polygon of four corners or more that is no longer convex along its normal. Other vertices may
/// hold anything.
template <int Dim>
[[nodiscard]] Overlaps<Dim> find_overlaps_moved(const SurfaceView<Dim>& surface, PointsView<Dim> x,
                                                std::span<const geometry::IndexPair> pairs,
                                                geometry::AreaMethod method = geometry::AreaMethod::fast);

/// As above, into memory that is used again.
template <int Dim>
void find_overlaps_moved(const SurfaceView<Dim>& surface, PointsView<Dim> x, std::span<const geometry::IndexPair> pairs,
                         geometry::AreaMethod method, Overlaps<Dim>& overlaps);

/// `overlap_polygons` of faces that turn and deform; `x` and errors as above.
template <int Dim>
[[nodiscard]] std::vector<std::vector<Vector<Dim>>> overlap_polygons_moved(const SurfaceView<Dim>& surface,
                                                                           PointsView<Dim> x,
                                                                           std::span<const geometry::IndexPair> pairs);

}  // namespace abut::contact
