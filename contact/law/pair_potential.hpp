#pragma once
// Private to the layer.
#include <cstdint>
#include <span>
#include <vector>

#include "abut/contact/law/node_friction.hpp"
#include "abut/contact/nodal_pairs.hpp"
#include "abut/contact/nodal_step.hpp"
#include "abut/contact/shared_work.hpp"
#include "abut/contact/side_outlines.hpp"

namespace abut::contact {

/// A step in which nothing happens; its nodes are set.
template <int Dim>
void clear_step(const NodalPairs<Dim>& listed, NodalStep<Dim>& step);

/// The law of contact on nodes: every pair by itself, docs/method.md, The potential of a pair; then friction between
/// those that press.
template <int Dim>
class PairPotential {
public:
    explicit PairPotential(bool events, FrictionOptions friction = {}, Sharing* sharing = nullptr)
        : events_(events), friction_(std::move(friction)), shared_(sharing) {}

    [[nodiscard]] const NodeFriction<Dim>& friction() const { return friction_; }

    /// Decides admission at x_0 where W = 0, then takes the forces of the step; fills `step`, whose nodes are set. Returns
    /// how many pairs are pressed in at x_0 without being contacts.
    std::int64_t apply(const NodalSurface<Dim>& surface, const SideOutlines<Dim>& sides, NodalPairs<Dim>& listed,
                       std::span<PairMemory> memory, FacetStore& facets, double dt, PointsView<Dim> x_0, PointsView<Dim> x_1,
                       TakenForce take, NodalStep<Dim>& step);

    /// The forces of one state, with the admission as it stands.
    void evaluate(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed, std::span<const PairMemory> memory,
                  const FacetStore& facets, PointsView<Dim> x, NodalStep<Dim>& step);

private:
    struct Outcome {
        geometry::PairMeanGradient<Dim> found;
        Vector<Dim> normal = Vector<Dim>::Zero();  ///< of both ends together, of any length
        double facing = 1.0;
        double interference_work = 0.0;  ///< NodalStep::interference_work
        bool admitted = false;
        bool inadmissible = false;
        bool active = false;
    };

    /// Calls find(p), which fills outcome p, for all p < n; then keep(p) for all of which nothing went wrong anywhere. Parts
    /// that share contact call `find` for as many pairs each.
    template <class Find, class Keep>
    void find_outcomes(std::size_t n, const Find& find, const Keep& keep);
    static void write(const Outcome& outcome, ShareWriter& out);
    static void read(ShareReader& in, Outcome& outcome);

    /// A pair that is not active leaves `found` as it was.
    void follow(const NodalPair<Dim>& pair, const SideOutlines<Dim>& sides, bool admitted, PointsView<Dim> x_0,
                PointsView<Dim> x_1, TakenForce take, Outcome& outcome) const;
    void take_force(const NodalPair<Dim>& pair, const geometry::PairCorners<Dim>& start,
                    const geometry::PairCorners<Dim>& end, TakenForce take, Outcome& outcome) const;
    static double interference_work(const NodalPair<Dim>& pair, const geometry::PairCorners<Dim>& start,
                                    const geometry::PairCorners<Dim>& end, TakenForce take);
    /// Adds up what these of the listed pairs do, in their order.
    void add_up(const NodalSurface<Dim>& surface, const NodalPairs<Dim>& listed, std::span<const NodalPair<Dim>> pairs,
                PointsView<Dim> x_0, PointsView<Dim> x_1, NodalStep<Dim>& step) const;

    void add_friction(const NodalSurface<Dim>& surface, std::span<const NodalPair<Dim>> pairs, FacetStore& facets, double dt,
                      PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take, NodalStep<Dim>& step);
    void add_pairs(const NodalSurface<Dim>& surface, std::span<const NodalPair<Dim>> pairs);
    /// Checks the sums of bodies, and adds up the work of rigid ones.
    static void finish(const NodalSurface<Dim>& surface, NodalStep<Dim>& step);

    static void add_pair(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair, const Outcome& outcome,
                         NodalStep<Dim>& step);

    bool events_;
    NodeFriction<Dim> friction_;
    SharedWork shared_;
    std::vector<Outcome> outcomes_;  // of the pairs in reach
};

}  // namespace abut::contact
