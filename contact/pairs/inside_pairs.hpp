#pragma once
// Private to the layer.
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
/// are bonded; facets of two bodies are marked from a quarter of D on. docs/method_details.md, A body that touches itself.
template <int Dim>
class InsidePairs {
public:
    InsidePairs() = default;
    /// `piece`: of each body, -1 where nothing is to be marked (n_bodies); facets as they are at rest, whose arrays must
    /// outlive it.
    InsidePairs(const SurfaceView<Dim>& facets, std::vector<std::int32_t> piece);

    /// Whether the pair bears a mark. May be asked from several threads at once.
    [[nodiscard]] bool has(FacetPair pair) const;
    [[nodiscard]] bool empty() const { return piece_.empty(); }
    /// `has` of increasing pairs. Those that it was asked for last cost less.
    [[nodiscard]] std::vector<char> marks_of(std::span<const FacetPair> pairs);
    /// Takes the mark away; the pair must have one.
    void take_away(FacetPair pair);

    /// Pairs whose mark is gone, increasing: with the surface at rest it says which are left.
    [[nodiscard]] const std::vector<FacetPair>& seen() const { return seen_; }
    /// Marks as they were when `seen` was this. Throws BadInput for a pair that bears no mark at rest.
    void restore(std::span<const FacetPair> seen);

private:
    [[nodiscard]] bool lies_inside_at_rest(FacetPair pair) const;
    [[nodiscard]] bool lie_along_crack(std::int32_t facet_1, std::int32_t facet_2) const;
    /// Gap below which a pair lies inside [m].
    [[nodiscard]] double highest_gap_inside(FacetPair pair) const;

    SurfaceView<Dim> facets_;
    std::vector<std::int32_t> piece_;   // of each body; empty: nothing is marked
    std::vector<double> reach_;         // of each facet of a piece, so far that a pair may lie inside [m]
    std::vector<std::int32_t> across_;  // of each facet, the body on a facet of which it lies; -1: none
    std::vector<FacetPair> seen_;       // increasing
    std::vector<FacetPair> asked_;      // pairs of the last `marks_of`, and whether they lie inside at rest
    std::vector<char> answers_;
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
