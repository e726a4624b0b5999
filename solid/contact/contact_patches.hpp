#pragma once
// Private to the sources of this layer.
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "abut/dynamics/filter.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact/contact_results.hpp"

namespace abut::solid {

/// Two faces in contact, by the points that move them: cells, or the points of a rigid body; none move an obstacle. On
/// several ranks, by their numbers among the points of all.
template <int Dim>
struct TouchingPoints {
    std::span<const std::int32_t> points_1;
    std::span<const std::int32_t> points_2;
    Vector<Dim> position;  ///< where an obstacle holds its partner (dynamics::Hold) [m]; of two bodies not used
    Vector<Dim> normal;    ///< along which it does
};

/// The prescribed faces of a cell hold it in the directions that are prescribed.
template <int Dim>
[[nodiscard]] std::vector<dynamics::Hold<Dim>> holds_of_cell(const Ccg<Dim>& ccg, std::int32_t cell);

/// These points, sorted into patches: those of one face are in one patch, and so are the two faces of a pair. In the
/// order of their first points. Obstacles hold a patch where they touch it, and what holds its points.
template <int Dim>
[[nodiscard]] std::vector<dynamics::ContactPatch<Dim>> contact_patches(
    std::span<const TouchingPoints<Dim>> touching,
    const std::function<std::vector<dynamics::Hold<Dim>>(std::int32_t point)>& holds_of_point);

}  // namespace abut::solid
