#include "abut/solid/load/body_moments.hpp"

#include <algorithm>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/state_fields.hpp"
#include "abut/dynamics/point_system.hpp"

namespace abut::solid {

template <int Dim>
BodyMoments<Dim>::BodyMoments(const Bodies<Dim>& bodies, const RankPart<Dim>& part) : bodies_(bodies), part_(part) {
    check();
    for (const BodyMoment<Dim>& law : bodies.options().moments)
        moments_.push_back({law, sum_of(law.body, 0.0, [&](std::int32_t i) { return bodies_.masses()[i]; })});
}

template <int Dim>
void BodyMoments<Dim>::check() const {
    for (const BodyMoment<Dim>& moment : bodies_.options().moments)
        if (moment.body < 0 || moment.body >= bodies_.mesh().n_bodies() || !moment.moment.allFinite() ||
            !(moment.damping >= 0.0))
            throw BadInput(bodies_.mesh().name + ": a moment on body " + std::to_string(moment.body) +
                           " with a damping of " + number(moment.damping) + " N m s; bodies are counted from 0 to " +
                           std::to_string(bodies_.mesh().n_bodies() - 1) +
                           ", moments are finite, and damping is >= 0. Correct SolidOptions::moments.");
}

template <int Dim>
bool BodyMoments<Dim>::damps() const {
    return std::ranges::any_of(moments_, [](const Held& moment) { return moment.law.damping > 0.0; });
}

template <int Dim>
void BodyMoments<Dim>::add(const PointStep<Dim>& step, std::span<Vector<Dim>> force, double& work) {
    const Points q_0 = step.q_0.all, q_1 = step.q_1.all;
    for (Held& moment : moments_) {
        const Middle middle = middle_of(moment, q_0, q_1);
        const AxialVector<Dim> spin =
            spin_at(moment, middle, q_0, q_1, [&](std::int32_t i) -> Vector<Dim> { return q_1[i] - q_0[i]; }) / step.dt;
        const AxialVector<Dim> brake = moment.law.damping * acting_rate(step.take, moment.spin, spin);
        work += add_moment(moment.law.body, moment_at(moment.law, step.time) - brake, middle, q_0, q_1, force);
        moment.spin = spin;
    }
}

template <int Dim>
void BodyMoments<Dim>::set_rates(const ByPoint<Dim>& q, const ByPoint<Dim>& v) {
    for (Held& moment : moments_) {
        const Middle middle = middle_of(moment, q.all, q.all);
        moment.spin = spin_at(moment, middle, q.all, q.all, [&](std::int32_t i) -> Vector<Dim> { return v.all[i]; });
    }
}

template <int Dim>
void BodyMoments<Dim>::add_at(const ByPoint<Dim>& q, double time, const TurnOf<Dim>& /*turn_of*/,
                              std::span<Vector<Dim>> force) const {
    for (const Held& moment : moments_) {
        const AxialVector<Dim> brake = moment.law.damping * moment.spin.value_or(AxialVector<Dim>::Zero());
        add_moment(moment.law.body, moment_at(moment.law, time) - brake, middle_of(moment, q.all, q.all), q.all, q.all,
                   force);
    }
}

template <int Dim>
AxialVector<Dim> BodyMoments<Dim>::moment_at(const BodyMoment<Dim>& law, double time) {
    if (!law.history) return law.moment;
    const AxialVector<Dim> moment = law.history(time);
    if (!moment.allFinite())
        throw BadInput("moment on body " + std::to_string(law.body) + ": its value at t = " + number(time) +
                       " s is not finite. Correct its value or history.");
    return moment;
}

/// Calls of_point(point) for the own cells of a body that deforms, or all points of a rigid one.
template <int Dim>
template <class OfPoint>
void BodyMoments<Dim>::for_each_here(std::int32_t body, const OfPoint& of_point) const {
    if (const std::int32_t deformable = bodies_.deformable_body(body); deformable >= 0) {
        for (const std::int32_t i : part_.own_cells_of(static_cast<std::size_t>(deformable))) of_point(i);
        return;
    }
    const auto [begin, end] = bodies_.points_of(body);
    for (std::int32_t i = begin; i < end; ++i) of_point(i);
}

/// Sum of term(point) over the points of a body.
template <int Dim>
template <class Value, class Term>
Value BodyMoments<Dim>::sum_of(std::int32_t body, const Value& zero, const Term& term) const {
    if (const std::int32_t deformable = bodies_.deformable_body(body); deformable >= 0)
        return part_.sum_of_body(static_cast<std::size_t>(deformable), zero, term);
    const auto [begin, end] = bodies_.points_of(body);
    return ordered_sum(end - begin, zero,
                       [&, first = begin](std::ptrdiff_t i) { return term(first + static_cast<std::int32_t>(i)); });
}

template <int Dim>
auto BodyMoments<Dim>::middle_of(const Held& held, Points q_0, Points q_1) const -> Middle {
    const std::int32_t body = held.law.body;
    const auto at = [&](std::int32_t i) -> Vector<Dim> { return bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]); };
    const Vector<Dim> moment_of_mass =
        sum_of(body, Vector<Dim>::Zero(), [&](std::int32_t i) -> Vector<Dim> { return bodies_.masses()[i] * at(i); });
    Middle middle{moment_of_mass / held.mass, Matrix<Dim>::Zero()};
    middle.second_moment = sum_of(body, Matrix<Dim>::Zero(), [&](std::int32_t i) -> Matrix<Dim> {
        const Vector<Dim> arm = at(i) - middle.centre;
        return bodies_.masses()[i] * arm * arm.transpose();
    });
    return middle;
}

template <int Dim>
template <class Velocity>
AxialVector<Dim> BodyMoments<Dim>::spin_at(const Held& held, const Middle& middle, Points q_0, Points q_1,
                                           const Velocity& velocity) const {
    const AxialVector<Dim> angular =
        sum_of(held.law.body, AxialVector<Dim>::Zero(), [&](std::int32_t i) -> AxialVector<Dim> {
            const Vector<Dim> arm = bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]) - middle.centre;
            return bodies_.masses()[i] * moment<Dim>(arm, Vector<Dim>(velocity(i)));
        });
    return spin_of<Dim>(middle.second_moment, angular);
}

/// Forces m alpha × x' that have this moment, x' being arms about the centre in the middle of the step. Their work [J].
template <int Dim>
double BodyMoments<Dim>::add_moment(std::int32_t body, const AxialVector<Dim>& moment, const Middle& middle, Points q_0,
                                    Points q_1, std::span<Vector<Dim>> force) const {
    const Matrix<Dim> turning = hat<Dim>(spin_of<Dim>(middle.second_moment, moment));
    const auto of_point = [&](std::int32_t i) -> Vector<Dim> {
        const Vector<Dim> arm = bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]) - middle.centre;
        return bodies_.masses()[i] * (turning * arm);
    };
    for_each_here(body, [&](std::int32_t i) { force[i] += of_point(i); });
    return sum_of(body, 0.0, [&](std::int32_t i) { return of_point(i).dot(q_1[i] - q_0[i]); });
}

template <int Dim>
void BodyMoments<Dim>::save(StateWriter& state) const {
    for (const Held& moment : moments_) put_value(state, moment.spin);
}

template <int Dim>
void BodyMoments<Dim>::restore(StateReader& state) {
    for (Held& moment : moments_) get_value(state, moment.spin);
}

template <int Dim>
void BodyMoments<Dim>::take_over(const PointLoad<Dim>& before) {
    const std::vector<Held>& old = dynamic_cast<const BodyMoments&>(before).moments_;
    if (moments_.size() != old.size())
        throw BadInput(bodies_.mesh().name + ": it has " + std::to_string(moments_.size()) +
                       " moments, and before there were " + std::to_string(old.size()) + ". Keep them.");
    for (std::size_t i = 0; i < moments_.size(); ++i) moments_[i].spin = old[i].spin;
}

template class BodyMoments<2>;
template class BodyMoments<3>;

}  // namespace abut::solid
