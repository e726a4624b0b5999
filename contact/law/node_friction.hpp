#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/contact/facet_store.hpp"
#include "abut/contact/friction.hpp"
#include "abut/contact/law/friction_pair.hpp"
#include "abut/contact/law/friction_pass.hpp"
#include "abut/contact/nodal_pairs.hpp"
#include "abut/contact/nodal_step.hpp"
#include "abut/geometry/pair_potential/pair_slip.hpp"

namespace abut::contact {

/// Friction beside the pair potential, on facets that turn: a force between each two facets that press, along both, by
/// geometry::PairSlip. It is added to a step whose normal forces are there. docs/friction.md.
template <int Dim>
class NodeFriction {
public:
    explicit NodeFriction(FrictionOptions options) : options_(std::move(options)) {}

    [[nodiscard]] bool any() const { return options_.any(); }
    [[nodiscard]] std::int32_t memory() const { return any() ? friction_memory<Dim - 1> : 0; }
    /// E of all springs [J].
    [[nodiscard]] double stored_energy(const FacetStore& facets) const {
        return any() ? stick_energy<Dim - 1>(facets) : 0.0;
    }

    /// A step from x_0 to x_1 of `dt` [s]; `add` for each active pair of `step.pairs`, in their order; then `apply`.
    void begin(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take);
    void add(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair, const geometry::PairPressure<Dim>& pressure,
             double area, double active_share);
    void apply(const NodalSurface<Dim>& surface, FacetStore& facets, NodalStep<Dim>& step);

    /// Whether the pairs that the springs act on are those of the last step. Before the first one and after `forget` they are
    /// those of the state that is evaluated: `begin`, with that state at both ends, `add`, `weigh`, then `evaluate`.
    [[nodiscard]] bool has_stepped() const { return has_stepped_; }
    void weigh();
    /// The forces of the springs as they are, at x, with the weights of the last step, or of `weigh`: those that an evaluation
    /// adds to the normal forces. `active`: facets of `step.pairs`, in their order.
    void evaluate(const NodalSurface<Dim>& surface, const FacetStore& facets, PointsView<Dim> x,
                  std::span<const FacetPair> active, NodalStep<Dim>& step) const;
    void forget() {
        last_.clear();
        has_stepped_ = false;
    }

private:
    static constexpr int n_tangents = Dim - 1;
    using Half = FrictionHalf<n_tangents>;
    using Corners = geometry::PairCorners<Dim>;

    /// Indices in a step of all that the forces on a pair are added to; -1: the step does not have it.
    struct Indices {
        std::array<std::int32_t, 2 * Dim> listed;  // of each corner
        std::array<std::int32_t, 2> body;
        std::int32_t body_pair;
        std::int32_t pair;
        bool bodies_in_order;
    };
    struct Sliding {
        geometry::PairSlip<Dim> slip;
        Indices indices;
    };
    /// Pair of the last step: its corners, where it pressed, and its part in the friction of both facets.
    struct Last {
        std::array<std::int32_t, 2 * Dim> node;
        FrictionPair facets;
        geometry::PairPressure<Dim> pressure;
    };

    [[nodiscard]] static Corners corners(const Last& last, PointsView<Dim> x);
    [[nodiscard]] static Indices indices_in(const NodalStep<Dim>& step, const NodalSurface<Dim>& surface,
                                            std::span<const FacetPair> active, const Last& last);
    /// `force`: on face 2.
    static void add_force(const Last& last, const Indices& indices, const geometry::PairSlip<Dim>& slip,
                          const Vector<Dim>& force, PointsView<Dim> x_0, PointsView<Dim> x_1, NodalStep<Dim>& step);

    FrictionOptions options_;
    FrictionPass<n_tangents> pass_;
    double dt_ = 0.0;
    PointsView<Dim> x_0_, x_1_;
    TakenForce take_ = TakenForce::mean;
    bool has_stepped_ = false;
    std::int32_t n_pairs_ = 0;  // of the step so far
    std::vector<Half> halves_;
    std::vector<Sliding> sliding_;  // pairs with friction
    std::vector<Last> last_;        // of the same, in the same order
};

}  // namespace abut::contact
