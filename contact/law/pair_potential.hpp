#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/law/node_friction.hpp"
#include "abut/contact/nodal_step.hpp"
#include "abut/contact/pairs/nodal_pairs.hpp"
#include "abut/contact/shared_work.hpp"
#include "abut/contact/surface/side_outlines.hpp"

namespace abut::contact {

/// A step in which nothing happens; its nodes are set.
template <int Dim>
void clear_step(const NodalPairs<Dim>& listed, NodalStep<Dim>& step);

/// The law of contact on nodes: every pair by itself, docs/method.md, The potential of a pair; then friction between
/// those that press.
template <int Dim>
class PairPotential {
public:
    explicit PairPotential(const geometry::PairPathOptions& path, FrictionOptions friction = {}, Sharing* sharing = nullptr)
        : path_(path), friction_(std::move(friction)), shared_(sharing) {}

    [[nodiscard]] const NodeFriction<Dim>& friction() const { return friction_; }

    /// Decides admission at x_0 where W = 0, of contacts that have no force when they have one, and takes the forces of the
    /// step; fills `step`, whose nodes are set. Returns how many pairs are pressed in at x_0 without being contacts.
    std::int64_t apply(const NodalSurface<Dim>& surface, const SideOutlines<Dim>& sides, NodalPairs<Dim>& listed,
                       std::span<PairMemory> memory, FacetStore& facets, double dt, PointsView<Dim> x_0, PointsView<Dim> x_1,
                       TakenForce take, NodalStep<Dim>& step);

    /// The forces of one state, with the admission as it stands.
    void evaluate(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed, std::span<const PairMemory> memory,
                  const FacetStore& facets, PointsView<Dim> x, NodalStep<Dim>& step);

private:
    using Pairs = std::span<const NodalPair<Dim>>;

    /// A look at a pair at both ends of a step, before its force is asked for.
    struct Glance {
        bool admitted = false;
        bool inadmissible = false;
        bool may_act = false;            ///< its force is asked for
        bool is_decided = false;         ///< it is admitted, whatever its force
        bool may_be_pressed_in = false;  ///< it was admitted, and may be pressed in at the start
        std::int32_t start = -1;         ///< index in `kept_` of its start; -1: not known
    };
    /// The action of a pair that may act.
    struct Outcome {
        std::size_t pair;
        bool active;
        double interference_work;  ///< NodalStep::interference_work
        geometry::PairMeanGradient<Dim> found;
    };
    /// The end of the last step of a pair: the start of the next one where its nodes have not moved since.
    struct Kept {
        FacetPair facets;
        double offset;  ///< of its law
        geometry::PairEnd<Dim> end;
    };

    /// Fills `glances_` by glance(p, whether it is known to be pressed in at the start) and `outcomes_` by the forces of the
    /// step, for all pairs; parts that share contact do so for as many pairs each.
    template <class GlanceAt>
    void find_outcomes(Pairs pairs, const SideOutlines<Dim>* sides, PointsView<Dim> x_0, PointsView<Dim> x_1,
                       TakenForce take, const GlanceAt& glance);
    /// For some of the pairs.
    template <class GlanceAt>
    void find_part(const IndexRange& range, Pairs pairs, const SideOutlines<Dim>* sides, PointsView<Dim> x_0,
                   PointsView<Dim> x_1, TakenForce take, const GlanceAt& glance);
    void write(const IndexRange& range, ShareWriter& out) const;
    /// Appends to `outcomes`.
    void read(const IndexRange& range, ShareReader& in, std::vector<Outcome>& outcomes);

    static Glance glance_at_step(const NodalPair<Dim>& pair, bool admitted, bool is_pressed_in, PointsView<Dim> x_0,
                                 PointsView<Dim> x_1);
    /// Finds which nodes are where the last step has left them, and leaves them where this one does.
    void find_resting_nodes(std::span<const std::int32_t> nodes, PointsView<Dim> x);
    void leave_nodes(std::span<const std::int32_t> nodes, PointsView<Dim> x);
    /// Index of the start of a pair in `kept_`, from `from` on; -1: it is not known. `from` moves on.
    [[nodiscard]] std::int32_t find_start(const NodalPair<Dim>& pair, std::size_t& from) const;
    /// Finds the forces of these outcomes, and what the next step may begin with.
    void take_forces(const IndexRange& range, Pairs pairs, PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take);
    static void decide(const NodalPair<Dim>& pair, const SideOutlines<Dim>& sides, PointsView<Dim> x_0, Glance& glance,
                       Outcome& outcome);
    /// Decides what the force alone can tell.
    void conclude(const NodalPair<Dim>& pair, const SideOutlines<Dim>* sides, PointsView<Dim> x_0, PointsView<Dim> x_1,
                  TakenForce take, Outcome& outcome);
    static double interference_work(const NodalPair<Dim>& pair, const geometry::PairCorners<Dim>& start,
                                    const geometry::PairCorners<Dim>& end, TakenForce take);
    /// Adds up what these of the listed pairs do, in their order.
    void add_up(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed, Pairs pairs, PointsView<Dim> x_0,
                PointsView<Dim> x_1, NodalStep<Dim>& step) const;

    void add_friction(const NodalSurface<Dim>& surface, Pairs pairs, FacetStore& facets, double dt, PointsView<Dim> x_0,
                      PointsView<Dim> x_1, TakenForce take, NodalStep<Dim>& step);
    void add_pairs(const NodalSurface<Dim>& surface, Pairs pairs);
    /// Checks the sums of bodies, and adds up the work of rigid ones.
    static void finish(const NodalSurface<Dim>& surface, NodalStep<Dim>& step);

    static void add_pair(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair, const Outcome& outcome,
                         NodalStep<Dim>& step);

    geometry::PairPathOptions path_;
    NodeFriction<Dim> friction_;
    SharedWork shared_;
    std::vector<Glance> glances_;       // of the pairs in reach
    std::vector<Outcome> outcomes_;     // of those that may act, in their order
    std::vector<Kept> kept_, ending_;   // of the last step and the present one, by facets
    std::vector<Vector<Dim>> left_at_;  // by node: where the last step that listed it has left it
    std::vector<char> rests_;           // of the listed nodes: whether it is there
};

}  // namespace abut::contact
