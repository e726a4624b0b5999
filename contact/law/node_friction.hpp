#pragma once
// Private to the layer.
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "abut/contact/friction.hpp"
#include "abut/contact/law/friction_pair.hpp"
#include "abut/contact/law/friction_pass.hpp"
#include "abut/contact/nodal_step.hpp"
#include "abut/contact/pairs/nodal_pairs.hpp"
#include "abut/contact/surface/facet_store.hpp"
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

    /// A state: `begin` with it at both ends, `add`, then the forces of the springs as they are, which it adds to the
    /// normal forces.
    void evaluate(const NodalSurface<Dim>& surface, const FacetStore& facets, NodalStep<Dim>& step);

private:
    static constexpr int n_tangents = Dim - 1;
    using Half = FrictionHalf<n_tangents>;
    using Corners = geometry::PairCorners<Dim>;

    /// Two facets that press and rub: their corners, where they press, their part in the friction of both, and the
    /// indices in the step of all that its forces are added to.
    struct Pair {
        std::array<std::int32_t, 2 * Dim> node;
        std::array<std::int32_t, 2 * Dim> listed;
        std::array<std::int32_t, 2> body;
        std::int32_t body_pair;
        std::int32_t in_step;
        geometry::PairPressure<Dim> pressure;
        geometry::PairSlip<Dim> slip;
        FrictionPair facets;
    };

    [[nodiscard]] Corners at_end(const Pair& pair) const;
    /// `force`: on face 2.
    static void add_force(const Pair& pair, const geometry::PairSlip<Dim>& slip, const Vector<Dim>& force,
                          PointsView<Dim> x_0, PointsView<Dim> x_1, NodalStep<Dim>& step);

    FrictionOptions options_;
    FrictionPass<n_tangents> pass_;
    double dt_ = 0.0;
    PointsView<Dim> x_0_, x_1_;
    TakenForce take_ = TakenForce::mean;
    std::int32_t n_pairs_ = 0;  // so far
    std::vector<Half> halves_;
    std::vector<Pair> pairs_;  // with friction
};

}  // namespace abut::contact
