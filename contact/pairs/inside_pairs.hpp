#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/pair_store.hpp"
#include "abut/contact/surface/surface.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::contact {

/// Pairs of facets of one piece that lie inside of each other and near at rest, as the two sides of a wedge or of a thin
/// plate do: they are marked, and no contact. A mark goes for good once the pair is seen from outside: a plate that is
/// rolled up touches itself with what were its two sides. A piece is a body that touches itself, or bodies that were one or
/// are bonded. docs/method_details.md, A body that touches itself.
template <int Dim>
class InsidePairs {
public:
    InsidePairs() = default;
    /// `piece`: of each body, -1 where nothing is to be marked (n_bodies); facets as they are at rest.
    InsidePairs(const SurfaceView<Dim>& facets, const std::vector<std::int32_t>& piece);

    /// Whether the pair bears a mark.
    [[nodiscard]] bool has(FacetPair pair) const;
    [[nodiscard]] bool empty() const { return partners_.empty(); }
    /// Takes the mark away; the pair must have one.
    void take_away(FacetPair pair);

    /// Pairs whose mark is gone, increasing: with the surface at rest it says which are left.
    [[nodiscard]] std::vector<FacetPair> seen() const;
    /// Marks as they were when `seen` was this. Throws BadInput for a pair that bears no mark at rest.
    void restore(std::span<const FacetPair> seen);

private:
    /// Index in `partners_`; -1: it was never marked.
    [[nodiscard]] std::ptrdiff_t index_of(FacetPair pair) const;

    std::vector<std::size_t> offsets_;    // of each facet, into the arrays below
    std::vector<std::int32_t> partners_;  // of the lower facet of each pair, increasing
    std::vector<char> is_seen_;
};

/// A pair whose gap is not below this is outside of its body [m]: 0, less what rounding adds.
template <int Dim>
[[nodiscard]] double outside_gap(const SurfaceView<Dim>& facets, FacetPair pair);

/// By which a pair is told to lie inside or outside: its least gap where the facets overlap; else that gap and the one
/// of both planes halfway between the centroids, whichever is less, since facets at an edge may be beside each other
/// with a common corner. Not finite without a normal in common: it tells nothing then [m].
template <int Dim>
[[nodiscard]] double inside_gap(const geometry::PairCorners<Dim>& corners, const geometry::PairState<Dim>& state);

}  // namespace abut::contact
