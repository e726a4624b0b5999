#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "abut/geometry/broad_phase/broad_phase.hpp"
#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// Cells up to this part of their size inside each other count as touching: libccd's depth is no more accurate.
inline constexpr double touching_tolerance = 1e-6;

/// Two cells of different bodies that share volume.
struct Interpenetration {
    std::array<std::int32_t, 2> bodies;  ///< bodies[0] < bodies[1]
    std::array<std::int32_t, 2> cells;   ///< one of each, index in the mesh
    double depth;                        ///< [m], > 0: the shortest translation that parts these two cells
};

/// Pairs of bodies, in either order, that may overlap.
using IgnoredPairs = std::span<const std::array<std::int32_t, 2>>;

/// When a search for cells that overlap ends early: so many are enough to tell of bodies that overlap by mistake, and
/// the depth of two cells takes 0.1 ms. It counts, so that the same mesh gives the same pairs everywhere.
struct InterpenetrationLimits {
    std::int64_t of_two_bodies = std::numeric_limits<std::int64_t>::max();
    std::int64_t in_all = std::numeric_limits<std::int64_t>::max();
};
/// Limits for `check_apart` and for the check of a scene.
inline constexpr InterpenetrationLimits enough_interpenetrations{.of_two_bodies = 100, .in_all = 5000};

/// All pairs of cells of different bodies that overlap, or the first so many, deepest first (equal depths by cells).
/// Every cell is taken as the convex hull of its vertices. Cells that touch, or overlap by no more than
/// `touching_tolerance` of the larger one's diameter, are none. A body that lies wholly inside another is found: its
/// cells overlap those around it. The depth is that of two cells: bodies that are far inside each other have to be
/// moved further.
template <int Dim>
[[nodiscard]] std::vector<Interpenetration> find_interpenetrations(
    const Mesh<Dim>& mesh, geometry::BroadPhase broad_phase = geometry::BroadPhase::automatic, IgnoredPairs ignored = {},
    InterpenetrationLimits limits = {});

/// Throws MeshError if there are any, naming the bodies, how many pairs of cells, and which are the deepest, of
/// `enough_interpenetrations`; `remedy` ends the message. To be called before a run: contact takes what overlaps at the
/// start for pressed together.
template <int Dim>
void check_apart(const Mesh<Dim>& mesh, const std::string& remedy = "Move the bodies apart.",
                 geometry::BroadPhase broad_phase = geometry::BroadPhase::automatic, IgnoredPairs ignored = {});

}  // namespace abut::mesh
