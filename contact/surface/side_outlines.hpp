#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <vector>

#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/pair_potential/pair_approach.hpp"

namespace abut::contact {

/// Outlines of the sides of bodies. A side of a facet is all that is joined to it and looks much the way it does: it
/// ends at a convex edge (3D) or corner (2D) where normals turn by more than at a sharp edge (`sharp_edge_cosine`), and
/// where the surface is open; where two faces make a groove it is taken to go on. Near a corner below 60 degrees (2D) a
/// body is thinner than a contact may be deep: there its side counts as far as half its thickness. Of the surface at
/// rest, for facets of Dim corners.
template <int Dim>
class SideOutlines;

template <>
class SideOutlines<2> {
public:
    explicit SideOutlines(const SurfaceView<2>& facets);
    /// How deep a pair may be that begins to overlap past this part of the outline of a facet [m]: 0 where its side ends,
    /// infinity where it goes on.
    [[nodiscard]] double deepest_past(std::int32_t facet, const geometry::OutlinePart& part) const {
        return deepest_[static_cast<std::size_t>(2 * facet + part.corner)];
    }

private:
    std::vector<double> deepest_;  // past each corner of each facet
};

template <>
class SideOutlines<3> {
public:
    explicit SideOutlines(const SurfaceView<3>& facets);
    [[nodiscard]] double deepest_past(std::int32_t facet, const geometry::OutlinePart& part) const;

private:
    [[nodiscard]] bool goes_on(std::int32_t facet, const geometry::OutlinePart& part) const;

    struct Reach {
        float past_next = 0.0F;      // beyond the edge to the next corner [rad]; infinity: all around
        float past_previous = 0.0F;  // beyond that to the previous corner
    };
    std::vector<Reach> reach_;           // of the side around each corner of each facet
    std::vector<std::uint8_t> goes_on_;  // past the edge from each corner of each facet to the next one
};

}  // namespace abut::contact
