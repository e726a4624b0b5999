#pragma once
// Private to the layer.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "abut/base/ids.hpp"
#include "abut/contact/law/interference_ramps.hpp"
#include "abut/contact/law/law_memory.hpp"
#include "abut/contact/law/pair_potential.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/pair_store.hpp"
#include "abut/contact/pairs/admission.hpp"
#include "abut/contact/pairs/inside_pairs.hpp"
#include "abut/contact/pairs/nodal_pairs.hpp"
#include "abut/contact/pairs/watched_pairs.hpp"
#include "abut/contact/search/candidate_search.hpp"
#include "abut/contact/surface/bevels.hpp"
#include "abut/contact/surface/facet_store.hpp"
#include "abut/contact/surface/nodal_surface.hpp"
#include "abut/contact/surface/side_outlines.hpp"

namespace abut::contact {

/// The law of NodalContact as the engine wants it: facets between nodes, under the pair potential. docs/method.md, The
/// potential of a pair.
template <int Dim>
class NodeLaw {
public:
    static constexpr int dimension = Dim;
    using State = PointsView<Dim>;  ///< positions of all nodes, corners of bevels last (BevelledSurface::place) [m]
    struct Path {
        PointsView<Dim> x_0;
        PointsView<Dim> x_1;
        TakenForce take;
    };
    using Step = NodalStep<Dim>;

    NodeLaw(BevelledSurface<Dim> surface, const NodalOptions& options, Sharing* sharing);

    [[nodiscard]] std::string name() const { return "nodal contact"; }
    [[nodiscard]] SurfaceView<Dim> facets() const { return acting().facets().view(); }
    [[nodiscard]] std::string face_name(Face face) const;
    [[nodiscard]] std::int32_t facet_memory() const { return law_.friction().memory(); }
    [[nodiscard]] double stored_energy(const FacetStore& facets) const { return law_.friction().stored_energy(facets); }
    [[nodiscard]] std::ptrdiff_t n_watched() const { return std::ssize(acting().nodes()); }
    [[nodiscard]] Vector<Dim> position(State x, std::ptrdiff_t i) const {
        return x[acting().nodes()[static_cast<std::size_t>(i)]];
    }

    void search(CandidateSearch<Dim>& candidates, State x_0, State x_1);
    /// Whether nothing could touch a facet in the last search.
    [[nodiscard]] bool is_covered(Facet facet) const {
        return !covered_.empty() && covered_[static_cast<std::size_t>(facet)] != 0;
    }
    /// Whether a facet of bodies that touch themselves has turned since the last search by more than lists allow for.
    [[nodiscard]] bool has_turned(State x) const;
    [[nodiscard]] bool is_wanted(FacetPair pair) const {
        return !is_covered(pair.facet_1) && !is_covered(pair.facet_2) &&
               surface_.may_meet(number_of(pair.facet_1), number_of(pair.facet_2)) &&
               (!options_.wanted || options_.wanted(acting().face_of(pair.facet_1), acting().face_of(pair.facet_2)));
    }
    void list(std::vector<FacetPair>& pairs, std::span<const FacetPair> in_contact, State x_0, double reach);
    void list_remembered(std::span<const FacetPair> pairs) { pairs_.assign(surface_, pairs); }
    void drop_list() {
        watched_.clear();
        pairs_.assign(surface_, {});
    }
    [[nodiscard]] bool is_pressed_in(std::size_t pair, State x) const;
    [[nodiscard]] FirstLook decide_first(std::size_t pair, State x, bool run_begins) const;
    /// PairMemory::offset of all pairs of the list.
    void set_born_offsets(std::span<const PairMemory> memory) { pairs_.set_born_offsets(memory); }
    [[nodiscard]] bool lies_inside(FacetPair pair) const { return inside_.has(pair); }
    [[nodiscard]] bool sees_from_outside(const Path& path);
    [[nodiscard]] std::span<const double> interference() const { return ramps_.overlaps(); }
    [[nodiscard]] LawMemory memory() const { return {inside_.seen(), ramps_.saved()}; }
    void set_memory(const LawMemory& memory);
    void end_step(double dt) { ramps_.advance(dt); }

    void clear(NodalStep<Dim>& step) const;
    std::int64_t step(double dt, const Path& path, std::span<PairMemory> memory, FacetStore& facets, NodalStep<Dim>& step);
    void evaluate(State x, std::span<const PairMemory> memory, const FacetStore& facets, NodalStep<Dim>& step);

    [[nodiscard]] const BevelledSurface<Dim>& surface() const { return surface_; }
    /// Nodes of the pairs of the list, corners of bevels last.
    [[nodiscard]] const std::vector<std::int32_t>& listed_nodes() const { return pairs_.nodes(); }
    /// This law on another surface, without a list.
    [[nodiscard]] NodeLaw on(NodalSurface<Dim> surface) const {
        return {BevelledSurface<Dim>(std::move(surface)), options_, sharing_};
    }

private:
    [[nodiscard]] const NodalSurface<Dim>& acting() const { return surface_.acting(); }
    /// A step has the corners of bevels while it is made, and the nodes of the host alone in the end.
    void unfold(NodalStep<Dim>& step) const {
        if (step.nodes.size() != listed_nodes().size()) step.nodes = listed_nodes();
    }
    void fold(NodalStep<Dim>& step) const { surface_.fold(step.nodes, step.gradient); }
    struct PlacedFacets {
        std::vector<Vector<Dim>> middle, normal;  // of each facet
    };
    [[nodiscard]] Vector<Dim> normal_of(std::int32_t facet, State x) const;
    void place_facets(State x, PlacedFacets& placed);
    [[nodiscard]] bool may_come_together(FacetPair pair, const PlacedFacets& placed, double reach) const;
    [[nodiscard]] bool is_seen_from_outside(const NodalPair<Dim>& pair, State x) const;
    void set_inside_pairs_apart(std::vector<FacetPair>& pairs, State x_0);
    [[nodiscard]] double idle_overlap(const NodalPair<Dim>& pair, State x) const;
    void begin_interference(State x_0);
    [[noreturn]] void refuse_deep_interference(const NodalPair<Dim>& pair) const;
    void set_offsets(double dt);

    BevelledSurface<Dim> surface_;
    NodalOptions options_;
    Sharing* sharing_;
    SideOutlines<Dim> sides_;
    InsidePairs<Dim> inside_;
    WatchedPairs<Dim> watched_;       // of these, that may be seen from outside while the list is valid
    PlacedFacets at_start_, at_end_;  // of the step of a search
    std::vector<double> radius_;      // of facets at rest [m]
    std::vector<char> covered_;       // facets that the last search left out; empty: none
    NodalPairs<Dim> pairs_;
    InterferenceRamps ramps_;
    double looks_away_;  // n_1 . n_2 of two facets of one body that have no weight for as long as a list is valid
    PairPotential<Dim> law_;
    std::int32_t least_force_size_ = 0;  // nodes up to the last one of a deformable face
};

}  // namespace abut::contact
