#pragma once
// Private to the layer.
#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "abut/base/ids.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/interference.hpp"
#include "abut/contact/pair_store.hpp"
#include "abut/contact/pairs/admission.hpp"
#include "abut/contact/shared_work.hpp"
#include "abut/contact/surface/bevels.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/contact/surface/side_outlines.hpp"
#include "abut/geometry/pair_potential/pair_approach.hpp"
#include "abut/geometry/pair_potential/pair_potential.hpp"

namespace abut::contact {

/// Two facets that may touch, and all that a step needs of them.
template <int Dim>
struct NodalPair {
    std::int32_t facet_1;
    std::int32_t facet_2;
    std::array<std::int32_t, 2 * Dim> node;    ///< corners of facet 1, then of facet 2
    std::array<std::int32_t, 2 * Dim> listed;  ///< index of each in the listed nodes
    std::int32_t body_1;                       ///< index in the listed bodies
    std::int32_t body_2;
    std::int32_t body_pair;  ///< index in the listed pairs of bodies
    std::int32_t memory;     ///< index of what it remembers
    geometry::PairLaw<Dim> law;
    double admission_depth;                ///< D = d_1 + d_2 [m]
    bool has_bevel = false;                ///< one of its facets is a bevel
    std::int32_t friction = -1;            ///< index of its law of friction; -1: none
    std::int32_t interference = -1;        ///< index of its time in InterferenceOptions; -1: none
    double offset_before = 0.0;            ///< `law.offset` where the step begins [m]
    geometry::PairOutlook<Dim> outlook{};  ///< while the list holds

    [[nodiscard]] geometry::PairCorners<Dim> at(PointsView<Dim> x) const {
        geometry::PairCorners<Dim> corners;
        for (std::size_t v = 0; v < node.size(); ++v) corners[v] = x[node[v]];
        return corners;
    }
};

struct BodyPair {
    std::int32_t body_1;  ///< the lower one
    std::int32_t body_2;
    friend auto operator<=>(const BodyPair&, const BodyPair&) = default;
};

/// The pairs of a candidate list, in its order; their nodes and bodies.
template <int Dim>
class NodalPairs {
public:
    explicit NodalPairs(const geometry::FacingFade& facing, FrictionOptions friction = {},
                        InterferenceOptions interference = {}, Sharing* sharing = nullptr)
        : facing_(facing),
          friction_(std::move(friction)),
          interference_(std::move(interference)),
          offsets_(interference_.times.size(), 0.0),
          shared_(sharing) {}

    /// For all positions in which no node is farther than `reach` from where x has it [m]. Leaves out of `facets` what
    /// cannot act there with |g| up to `compression` D, except those `in_contact` (increasing): boxes know nothing of how
    /// faces lie to each other. The nodes of `watched` pairs are listed, too.
    void assign(const BevelledSurface<Dim>& surface, std::vector<FacetPair>& facets, std::span<const FacetPair> in_contact,
                std::span<const NodalPair<Dim>> watched, PointsView<Dim> x, double reach, double compression);
    /// Pairs without an outlook: of a list that does not hold.
    void assign(const BevelledSurface<Dim>& surface, std::span<const FacetPair> facets);
    [[nodiscard]] std::span<const NodalPair<Dim>> pairs() const { return pairs_; }
    /// A pair that is in no list.
    [[nodiscard]] NodalPair<Dim> make_pair(const BevelledSurface<Dim>& surface, const FacetPair& facets) const;

    /// The list is pruned again and again while it holds: these of its pairs can act in the step from x_0 to x_1, and in the
    /// next ones as long as no node moves too far. They are chosen again where they must be; what leaves them is
    /// admitted from then on if it is apart, and else not, as if it had left the list. `memory`: of all pairs.
    [[nodiscard]] std::span<const NodalPair<Dim>> in_reach(PointsView<Dim> x_0, PointsView<Dim> x_1,
                                                           std::span<PairMemory> memory);
    /// Pairs that can act in one state, and others.
    [[nodiscard]] std::span<const NodalPair<Dim>> in_reach(PointsView<Dim> x) const;

    /// PairLaw::offset by InterferenceOptions::times at both ends of a step, of these pairs and those to come [m].
    void set_offsets(std::span<const double> start, std::span<const double> end);
    /// PairLaw::offset by what each pair remembers, which has no interference (n_pairs).
    void set_born_offsets(std::span<const PairMemory> memory);
    /// Pairs that are apart where a step ends have no such offset from then on.
    void end_born_offsets(PointsView<Dim> x_1, std::span<PairMemory> memory);

    [[nodiscard]] const std::vector<std::int32_t>& nodes() const { return nodes_; }        ///< increasing
    [[nodiscard]] const std::vector<std::int32_t>& bodies() const { return bodies_; }      ///< increasing
    [[nodiscard]] const std::vector<BodyPair>& body_pairs() const { return body_pairs_; }  ///< increasing

private:
    /// Lists nodes, bodies and pairs of bodies, and the indices of the pairs in these.
    void index(const BevelledSurface<Dim>& surface, std::span<const NodalPair<Dim>> watched = {});
    /// Calls use(index, outlook) for all pairs, in their order. Outlooks are for nodes that are not farther than `reach`
    /// from where x has them.
    template <class Use>
    void look_ahead(PointsView<Dim> x, double reach, const Use& use);
    /// Fills `outlooks_` for n pairs.
    void look_at(std::size_t begin, std::size_t n, PointsView<Dim> x, double reach);
    void prune(PointsView<Dim> x_0, PointsView<Dim> x_1, std::span<PairMemory> memory);
    [[nodiscard]] bool is_pruned_at(PointsView<Dim> x) const;

    geometry::FacingFade facing_;
    FrictionOptions friction_;
    InterferenceOptions interference_;
    std::vector<double> offsets_;  // of each of its times, at the end of the step [m]
    SharedWork shared_;
    std::vector<NodalPair<Dim>> pairs_;
    double compression_ = 0.0;  // |g|/D up to which pairs can act
    std::vector<std::int32_t> nodes_;
    std::vector<std::int32_t> bodies_;
    std::vector<BodyPair> body_pairs_;
    std::vector<std::int32_t> index_of_node_;  // in `nodes_`; that of others is not to be read

    bool any_born_offset_ = false;
    std::vector<NodalPair<Dim>> in_reach_;              // while no node is farther than `prune_reach_` from `pruned_at_`
    std::vector<Vector<Dim>> pruned_at_;                // of each node
    double prune_reach_ = 0.0;                          // [m]
    std::vector<geometry::PairOutlook<Dim>> outlooks_;  // work array, of some pairs
};

/// Deeper than this part of D, a pair that shares nothing begins to overlap from the side.
inline constexpr double beside_depth = 0.01;

/// Whether a pair may be pressed in from here on, where W = 0: it is no far side of a body. Sides that end on both bodies
/// where their overlap would begin, and are behind each other there, look past each other: two corners or edges, the tips of
/// which are thinner than D. Flanks that overlap without facing each other are contacts, for bodies turn; bevels are
/// none then. docs/method.md, The potential of a pair.
template <int Dim>
[[nodiscard]] bool may_touch(const NodalPair<Dim>& pair, const geometry::PairCorners<Dim>& corners,
                             const geometry::PairState<Dim>& state, const SideOutlines<Dim>& sides) {
    if (!std::isfinite(state.gap) || state.gap <= -pair.admission_depth) return false;
    if (state.gap > -beside_depth * pair.admission_depth) return true;
    if (state.overlap > 0.0) return !pair.has_bevel;
    const auto approach = geometry::pair_approach<Dim>(corners, pair.law);
    return -state.gap <
           std::max(sides.deepest_past(pair.facet_1, approach[0]), sides.deepest_past(pair.facet_2, approach[1]));
}

/// First admission of a pair that was not in the list before. Where the run begins the depth alone decides.
template <int Dim>
[[nodiscard]] FirstAdmission decide_first(const NodalPair<Dim>& pair, PointsView<Dim> x, const SideOutlines<Dim>& sides,
                                          bool run_begins) {
    const geometry::PairCorners<Dim> corners = pair.at(x);
    const auto state = geometry::pair_state<Dim>(corners, pair.law);
    const bool is_shallow = std::isfinite(state.gap) && state.gap > -pair.admission_depth;
    if (run_begins || state.energy > 0.0) return first_admission(is_shallow, state.energy > 0.0, run_begins);
    return may_touch<Dim>(pair, corners, state, sides) ? FirstAdmission::admitted : FirstAdmission::not_admitted;
}

}  // namespace abut::contact
