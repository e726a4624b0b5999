#include "abut/contact/law/node_friction.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "abut/base/ids.hpp"

namespace abut::contact {
namespace {

/// Index of a value in a sorted range; -1: it is not there.
template <class Range, class Value, class Key>
std::int32_t index_of(const Range& range, const Value& value, const Key& key) {
    const auto at = std::ranges::lower_bound(range, value, {}, key);
    return at != range.end() && key(*at) == value ? static_cast<std::int32_t>(at - range.begin()) : -1;
}

}  // namespace

template <int Dim>
void NodeFriction<Dim>::begin(double dt, PointsView<Dim> x_0, PointsView<Dim> x_1, TakenForce take) {
    dt_ = dt;
    x_0_ = x_0;
    x_1_ = x_1;
    take_ = take;
    n_pairs_ = 0;
    halves_.clear();
    sliding_.clear();
    last_.clear();
}

template <int Dim>
void NodeFriction<Dim>::add(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair,
                            const geometry::PairPressure<Dim>& pressure, double area, double active_share) {
    const std::int32_t index = n_pairs_++;
    double normal_force = 0.0;
    for (int v = 0; v < Dim; ++v) normal_force += pressure[v];
    const Pressing pressing{normal_force, area, active_share};
    if (pair.friction < 0 || !pressing.acts()) return;
    sliding_.push_back({.slip = geometry::PairSlip<Dim>(pair.at(x_0_), pair.at(x_1_), pressure),
                        .indices = {.listed = pair.listed,
                                    .body = {pair.body_1, pair.body_2},
                                    .body_pair = pair.body_pair,
                                    .pair = index,
                                    .bodies_in_order = pair.body_1 < pair.body_2}});
    last_.push_back(
        {.node = pair.node, .facets = {.facet = {Facet{pair.facet_1}, Facet{pair.facet_2}}}, .pressure = pressure});
    const geometry::PairSlip<Dim>& slip = sliding_.back().slip;
    append_halves<Dim>(
        surface.facets(), options_.laws[static_cast<std::size_t>(pair.friction)], pressing, slip.motion(),
        [&](std::size_t side) { return slip.tangents(static_cast<int>(side)); }, last_.back().facets, halves_);
}

template <int Dim>
void NodeFriction<Dim>::apply(const NodalSurface<Dim>& surface, FacetStore& facets, NodalStep<Dim>& step) {
    has_stepped_ = true;
    pass_.apply(dt_, take_, halves_, facets, step.report.friction, step.friction);
    for (FaceFriction& of_facet : step.friction) of_facet.face = surface.face_of(Facet{number_of(of_facet.face)});
    for (std::size_t s = 0; s < sliding_.size(); ++s) {
        const Sliding& sliding = sliding_[s];
        Last& last = last_[s];
        take_weights<n_tangents>(halves_, last.facets);
        const auto add = [&](const geometry::PairSlip<Dim>& slip, PointsView<Dim> x_0) {
            const Vector<Dim> force = force_on_second<Dim>(
                halves_, [&](std::size_t side) { return slip.tangents(static_cast<int>(side)); }, last.facets);
            add_force(last, sliding.indices, slip, force, x_0, x_1_, step);
        };
        if (take_ == TakenForce::mean) {
            add(sliding.slip, x_0_);
        } else {
            const Corners end = corners(last, x_1_);
            add(geometry::PairSlip<Dim>(end, end, last.pressure), x_1_);
        }
        const Vector<Dim> motion = sliding.slip.motion(), normal = sliding.slip.normal();
        step.pairs[static_cast<std::size_t>(sliding.indices.pair)].slip = motion - normal * normal.dot(motion);
    }
}

template <int Dim>
void NodeFriction<Dim>::weigh() {
    pass_.weigh(halves_);
    for (Last& last : last_) take_weights<n_tangents>(halves_, last.facets);
}

template <int Dim>
void NodeFriction<Dim>::evaluate(const NodalSurface<Dim>& surface, const FacetStore& facets, PointsView<Dim> x,
                                 std::span<const FacetPair> active, NodalStep<Dim>& step) const {
    step.report.friction.energy = stick_energy<n_tangents>(facets);
    for (const Last& last : last_) {
        const Corners at = corners(last, x);
        const geometry::PairSlip<Dim> slip(at, at, last.pressure);
        const Vector<Dim> force = spring_force_on_second<Dim>(
            facets, [&](std::size_t side) { return slip.tangents(static_cast<int>(side)); }, last.facets);
        const Indices indices = indices_in(step, surface, active, last);
        if (std::ranges::all_of(indices.listed, [](std::int32_t i) { return i >= 0; }))  // else it is far from where it was
            add_force(last, indices, slip, force, x, x, step);
    }
}

template <int Dim>
typename NodeFriction<Dim>::Corners NodeFriction<Dim>::corners(const Last& last, PointsView<Dim> x) {
    Corners corners;
    for (std::size_t v = 0; v < corners.size(); ++v) corners[v] = x[last.node[v]];
    return corners;
}

template <int Dim>
typename NodeFriction<Dim>::Indices NodeFriction<Dim>::indices_in(const NodalStep<Dim>& step,
                                                                  const NodalSurface<Dim>& surface,
                                                                  std::span<const FacetPair> active, const Last& last) {
    Indices indices;
    for (std::size_t v = 0; v < last.node.size(); ++v)
        indices.listed[v] = index_of(step.nodes, last.node[v], [](std::int32_t node) { return node; });
    const std::vector<std::int32_t>& body = surface.facets().body;
    const std::int32_t body_1 = body[number_of(last.facets.facet[0])], body_2 = body[number_of(last.facets.facet[1])];
    const auto number_of_body = [](const BodyStep<Dim>& of) { return of.body; };
    indices.body = {index_of(step.bodies, body_1, number_of_body), index_of(step.bodies, body_2, number_of_body)};
    indices.bodies_in_order = body_1 < body_2;
    indices.body_pair = index_of(step.body_pairs, std::pair(std::min(body_1, body_2), std::max(body_1, body_2)),
                                 [](const BodyPairStep<Dim>& of) { return std::pair(of.body_1, of.body_2); });
    indices.pair =
        index_of(active, FacetPair{last.facets.facet[0], last.facets.facet[1]}, [](const FacetPair& of) { return of; });
    return indices;
}

template <int Dim>
void NodeFriction<Dim>::add_force(const Last& last, const Indices& indices, const geometry::PairSlip<Dim>& slip,
                                  const Vector<Dim>& force, PointsView<Dim> x_0, PointsView<Dim> x_1, NodalStep<Dim>& step) {
    const Corners on_corners = slip.on_corners(force);
    for (std::size_t v = 0; v < on_corners.size(); ++v) {
        step.gradient[static_cast<std::size_t>(indices.listed[v])] -= on_corners[v];
        if (const std::int32_t b = indices.body[v / Dim]; b >= 0) {
            BodyStep<Dim>& body = step.bodies[static_cast<std::size_t>(b)];
            const Vector<Dim> start = x_0[last.node[v]], end = x_1[last.node[v]], middle = 0.5 * (start + end);
            body.force += on_corners[v];
            body.moment += moment<Dim>(middle, on_corners[v]);
            body.work -= on_corners[v].dot(end - start);
        }
    }
    if (indices.body_pair >= 0 && indices.body[0] != indices.body[1])
        step.body_pairs[static_cast<std::size_t>(indices.body_pair)].force +=
            indices.bodies_in_order ? force : Vector<Dim>(-force);
    if (indices.pair >= 0) {
        PairStep<Dim>& pair = step.pairs[static_cast<std::size_t>(indices.pair)];
        pair.force += force;
        pair.friction += force;
        pair.point = slip.point();
    }
}

template class NodeFriction<2>;
template class NodeFriction<3>;

}  // namespace abut::contact
