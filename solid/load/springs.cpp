#include "abut/solid/load/springs.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/state_fields.hpp"
#include "abut/solid/options/number_tables.hpp"

namespace abut::solid {
namespace {

/// The discrete gradient of k/2 (|r| - L)^2: along the mean of r, so that it has no moment about the mean positions.
template <int Dim>
Vector<Dim> mean_tension(const Spring<Dim>& law, const Vector<Dim>& r_0, const Vector<Dim>& r_1) {
    const double mean_length = 0.5 * (r_0.norm() + r_1.norm());
    const double share = law.length > 0.0 && mean_length > 0.0 ? 1.0 - law.length / mean_length : 1.0;
    return 0.5 * law.stiffness * share * (r_0 + r_1);
}

}  // namespace

template <int Dim>
Springs<Dim>::Springs(const Bodies<Dim>& bodies, HeldPlaces<Dim>& places, const HeldPoints<Dim>& held)
    : bodies_(bodies), held_(held) {
    for (const Spring<Dim>& law : bodies.options().springs) {
        require_allowed(bodies.mesh().name + ": a spring of SolidOptions::springs: its ", spring_numbers<Dim>, law);
        HeldPlace<Dim> first = places.of(law.first), second = places.of(law.second);
        springs_.push_back({std::move(first), std::move(second), law});
    }
}

template <int Dim>
bool Springs<Dim>::damps() const {
    return std::ranges::any_of(springs_, [](const Held& spring) { return spring.law.damping > 0.0; });
}

template <int Dim>
std::vector<HeldPlace<Dim>*> Springs<Dim>::places() {
    std::vector<HeldPlace<Dim>*> places;
    for (Held& spring : springs_) places.insert(places.end(), {&spring.first, &spring.second});
    return places;
}

template <int Dim>
double Springs<Dim>::energy(const ByPoint<Dim>& q) const {
    double energy = 0.0;
    for (const Held& spring : springs_) {
        const double stretch = (spring.second.at(q.held) - spring.first.at(q.held)).norm() - spring.law.length;
        energy += 0.5 * spring.law.stiffness * stretch * stretch;
    }
    return energy;
}

template <int Dim>
void Springs<Dim>::add(const PointStep<Dim>& step, std::span<Vector<Dim>> force, double& work) {
    for (Held& spring : springs_) {
        const Vector<Dim> r_0 = spring.second.at(step.q_0.held) - spring.first.at(step.q_0.held);
        const Vector<Dim> r_1 = spring.second.at(step.q_1.held) - spring.first.at(step.q_1.held);
        const Vector<Dim> middle = 0.5 * (r_0 + r_1);
        const Rate rate = rate_of(spring.law, middle, Vector<Dim>((r_1 - r_0) / step.dt));
        const Vector<Dim> damping = damping_tension(spring.law, middle, acting_rate(step.take, spring.rate, rate));
        push(spring, mean_tension(spring.law, step.take == contact::TakenForce::mean ? r_0 : r_1, r_1) + damping, force);
        work -= damping.dot(r_1 - r_0);
        spring.rate = rate;
    }
}

template <int Dim>
void Springs<Dim>::set_rates(const ByPoint<Dim>& q, const ByPoint<Dim>& v) {
    for (Held& spring : springs_)
        spring.rate = rate_of(spring.law, spring.second.at(q.held) - spring.first.at(q.held),
                              spring.second.displacement(v.held) - spring.first.displacement(v.held));
}

template <int Dim>
void Springs<Dim>::add_at(const ByPoint<Dim>& q, double /*time*/, const TurnOf<Dim>& /*turn_of*/,
                          std::span<Vector<Dim>> force) const {
    for (const Held& spring : springs_) {
        const Vector<Dim> r = spring.second.at(q.held) - spring.first.at(q.held);
        push(spring,
             mean_tension(spring.law, r, r) + damping_tension(spring.law, r, spring.rate.value_or(Rate(Rate::Zero()))),
             force);
    }
}

template <int Dim>
void Springs<Dim>::add_stiffness(const ByPoint<Dim>& q, std::span<Vector<Dim>> product) const {
    for (const Held& spring : springs_)
        push(spring, spring.law.stiffness * (spring.first.displacement(q.held) - spring.second.displacement(q.held)),
             product);
}

template <int Dim>
auto Springs<Dim>::rate_of(const Spring<Dim>& law, const Vector<Dim>& r, const Vector<Dim>& velocity) -> Rate {
    return law.length == 0.0 ? velocity : Rate(r.normalized().dot(velocity) * Rate::Unit(0));
}

/// Along the spring, or in all directions where it has no length.
template <int Dim>
Vector<Dim> Springs<Dim>::damping_tension(const Spring<Dim>& law, const Vector<Dim>& r, const Rate& rate) {
    return law.damping * (law.length == 0.0 ? rate : Vector<Dim>(rate[0] * r.normalized()));
}

template <int Dim>
void Springs<Dim>::push(const Held& spring, const Vector<Dim>& tension, std::span<Vector<Dim>> force) const {
    held_.push(spring.first, tension, force);
    held_.push(spring.second, -tension, force);
}

template <int Dim>
void Springs<Dim>::save(StateWriter& state) const {
    for (const Held& spring : springs_) put_value(state, spring.rate);
}

template <int Dim>
void Springs<Dim>::restore(StateReader& state) {
    for (Held& spring : springs_) get_value(state, spring.rate);
}

template <int Dim>
void Springs<Dim>::take_over(const PointLoad<Dim>& before) {
    const std::vector<Held>& old = dynamic_cast<const Springs&>(before).springs_;
    if (springs_.size() != old.size())
        throw BadInput(bodies_.mesh().name + ": it has " + std::to_string(springs_.size()) +
                       " springs, and before there were " + std::to_string(old.size()) + ". Keep them.");
    for (std::size_t i = 0; i < springs_.size(); ++i) springs_[i].rate = old[i].rate;
}

template class Springs<2>;
template class Springs<3>;

}  // namespace abut::solid
