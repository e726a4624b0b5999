#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/dynamics/filter.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact_results.hpp"

namespace abut::solid {

/// Two faces in contact, by the points that move them: cells, or the points of a rigid body; none move an obstacle.
template <int Dim>
struct TouchingPoints {
    std::span<const std::int32_t> points_1;
    std::span<const std::int32_t> points_2;
    Vector<Dim> position;  ///< where an obstacle holds its partner (dynamics::Hold) [m]; of two bodies not used
    Vector<Dim> normal;    ///< along which it does
};

/// These points, sorted into patches: those of one face are in one patch, and so are the two faces of a pair. In the order of
/// their first points. Obstacles hold a patch where they touch it; prescribed faces of its cells in the directions that are
/// prescribed.
template <int Dim>
[[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> contact_patches(const Ccg<Dim>& ccg,
                                                                       std::span<const TouchingPoints<Dim>> touching);

}  // namespace abut::solid
