#include "abut/contact/law/node_friction.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace abut::contact {
namespace {

/// Facets come with their index as face.
template <int Dim>
void name_faces(const NodalSurface<Dim>& surface, std::vector<FaceFriction>& of_facets) {
    for (FaceFriction& of_facet : of_facets) of_facet.face = surface.face_of(Facet{number_of(of_facet.face)});
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
    pairs_.clear();
}

template <int Dim>
void NodeFriction<Dim>::add(const NodalSurface<Dim>& surface, const NodalPair<Dim>& pair,
                            const geometry::PairPressure<Dim>& pressure, double area, double active_share) {
    const std::int32_t index = n_pairs_++;
    double normal_force = 0.0;
    for (int v = 0; v < Dim; ++v) normal_force += pressure[v];
    const Pressing pressing{normal_force, area, active_share};
    if (pair.friction < 0 || !pressing.acts()) return;
    pairs_.push_back({.node = pair.node,
                      .listed = pair.listed,
                      .body = {pair.body_1, pair.body_2},
                      .body_pair = pair.body_pair,
                      .in_step = index,
                      .pressure = pressure,
                      .slip = geometry::PairSlip<Dim>(pair.at(x_0_), pair.at(x_1_), pressure),
                      .facets = {.facet = {Facet{pair.facet_1}, Facet{pair.facet_2}}}});
    Pair& rubbing = pairs_.back();
    append_halves<Dim>(
        surface.facets(), options_.laws[static_cast<std::size_t>(pair.friction)], pressing, rubbing.slip.motion(),
        [&](std::size_t side) { return rubbing.slip.tangents(static_cast<int>(side)); }, rubbing.facets, halves_);
}

template <int Dim>
void NodeFriction<Dim>::apply(const NodalSurface<Dim>& surface, FacetStore& facets, NodalStep<Dim>& step) {
    pass_.apply(dt_, take_, halves_, facets, step.report.friction, step.friction);
    name_faces(surface, step.friction);
    for (Pair& pair : pairs_) {
        take_weights<n_tangents>(halves_, pair.facets);
        const auto add = [&](const geometry::PairSlip<Dim>& slip, PointsView<Dim> x_0) {
            const Vector<Dim> force = force_on_second<Dim>(
                halves_, [&](std::size_t side) { return slip.tangents(static_cast<int>(side)); }, pair.facets);
            add_force(pair, slip, force, x_0, x_1_, step);
        };
        if (take_ == TakenForce::mean) {
            add(pair.slip, x_0_);
        } else {
            const Corners end = at_end(pair);
            add(geometry::PairSlip<Dim>(end, end, pair.pressure), x_1_);
        }
        const Vector<Dim> motion = pair.slip.motion(), normal = pair.slip.normal();
        step.pairs[static_cast<std::size_t>(pair.in_step)].slip = motion - normal * normal.dot(motion);
    }
}

template <int Dim>
void NodeFriction<Dim>::evaluate(const NodalSurface<Dim>& surface, const FacetStore& facets, NodalStep<Dim>& step) {
    step.report.friction.energy = stick_energy<n_tangents>(facets);
    list_friction<n_tangents>(facets, step.friction);
    name_faces(surface, step.friction);
    pass_.weigh(halves_);
    for (Pair& pair : pairs_) {
        take_weights<n_tangents>(halves_, pair.facets);
        const Vector<Dim> force = spring_force_on_second<Dim>(
            facets, [&](std::size_t side) { return pair.slip.tangents(static_cast<int>(side)); }, pair.facets);
        add_force(pair, pair.slip, force, x_0_, x_1_, step);
    }
}

template <int Dim>
typename NodeFriction<Dim>::Corners NodeFriction<Dim>::at_end(const Pair& pair) const {
    Corners corners;
    for (std::size_t v = 0; v < corners.size(); ++v) corners[v] = x_1_[pair.node[v]];
    return corners;
}

template <int Dim>
void NodeFriction<Dim>::add_force(const Pair& pair, const geometry::PairSlip<Dim>& slip, const Vector<Dim>& force,
                                  PointsView<Dim> x_0, PointsView<Dim> x_1, NodalStep<Dim>& step) {
    const auto on_corners = slip.on_corners(force);
    const Vector<Dim> on_second = slip.scaled(force);
    for (std::size_t v = 0; v < on_corners.size(); ++v) {
        step.gradient[static_cast<std::size_t>(pair.listed[v])] -= on_corners[v];
        BodyStep<Dim>& body = step.bodies[static_cast<std::size_t>(pair.body[v / Dim])];
        const Vector<Dim> start = x_0[pair.node[v]], end = x_1[pair.node[v]], middle = 0.5 * (start + end);
        body.force += on_corners[v];
        body.moment += moment<Dim>(middle, on_corners[v]);
        body.work -= on_corners[v].dot(end - start);
    }
    if (pair.body[0] != pair.body[1])
        step.body_pairs[static_cast<std::size_t>(pair.body_pair)].force +=
            pair.body[0] < pair.body[1] ? on_second : Vector<Dim>(-on_second);
    PairStep<Dim>& of_step = step.pairs[static_cast<std::size_t>(pair.in_step)];
    of_step.force += on_second;
    of_step.friction += on_second;
    of_step.point = slip.point();
}

template class NodeFriction<2>;
template class NodeFriction<3>;

}  // namespace abut::contact
