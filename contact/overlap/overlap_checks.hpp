#pragma once
// Private to the layer.
#include <span>

#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"

namespace abut::contact {

/// Checks of what is given to `find_overlaps` and `overlap_polygon`. Throws BadInput for arrays whose sizes disagree.
template <int Dim>
void check_arrays(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement);

/// Throws BadInput for a pair that names a face that does not exist.
template <int Dim>
void check_indices(const SurfaceView<Dim>& surface, std::span<const geometry::IndexPair> pairs);

/// Throws as `check_indices`, and Diverged naming the face if one that a pair names has a displacement that is not
/// finite. What no pair names may hold anything. The arrays must have passed `check_arrays`.
template <int Dim>
void check_pairs(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement,
                 std::span<const geometry::IndexPair> pairs);

/// Checks as `check_pairs`, of one pair, which is alone.
template <int Dim>
void check_pair(const SurfaceView<Dim>& surface, std::span<const Vector<Dim>> displacement, geometry::IndexPair pair);

}  // namespace abut::contact
