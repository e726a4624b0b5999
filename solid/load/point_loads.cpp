#include "abut/solid/load/point_loads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/dynamics/point_system.hpp"

namespace abut::solid {
namespace {

constexpr double along_normal = 1e-12;    // what a pressure may have across, over all of it
constexpr std::size_t most_corners = 12;  // of a face, without memory of its own

/// The discrete gradient of k/2 (|r| - L)^2: along the mean of r, so that it has no moment about the mean positions.
template <int Dim>
Vector<Dim> mean_tension(const Spring<Dim>& law, const Vector<Dim>& r_0, const Vector<Dim>& r_1) {
    const double mean_length = 0.5 * (r_0.norm() + r_1.norm());
    const double share = law.length > 0.0 && mean_length > 0.0 ? 1.0 - law.length / mean_length : 1.0;
    return 0.5 * law.stiffness * share * (r_0 + r_1);
}

/// What a dashpot acts on in a step with the rate `now`: docs/method.md, Bodies that turn.
template <class Rate>
Rate acting(contact::TakenForce take, const std::optional<Rate>& before, const Rate& now) {
    return take == contact::TakenForce::mean && before ? Rate(0.5 * (*before + now)) : now;
}

}  // namespace

template <int Dim>
PointLoads<Dim>::PointLoads(const Bodies<Dim>& bodies, const RankPart<Dim>& part)
    : bodies_(bodies), options_(bodies.options()), part_(part) {
    HeldPlaces<Dim> places(bodies, part);
    hold_springs(places);
    hold_tractions(places);
    take_held_points();
    check_moments();
    for (const BodyMoment<Dim>& law : options_.moments)
        moments_.push_back({law, sum_of(law.body, 0.0, [&](std::int32_t i) { return bodies_.masses()[i]; })});
}

template <int Dim>
void PointLoads<Dim>::hold_springs(HeldPlaces<Dim>& places) {
    for (const Spring<Dim>& law : options_.springs) {
        for (const double value : {law.stiffness, law.length, law.damping})
            if (!(value >= 0.0) || !std::isfinite(value))
                throw BadInput(bodies_.mesh().name + ": a spring has the value " + number(value) +
                                   "; stiffness, length and damping must be finite and >= 0. Correct SolidOptions::springs.",
                               {.value = value, .allowed = 0.0});
        HeldPlace<Dim> first = places.of(law.first), second = places.of(law.second);
        springs_.push_back({std::move(first), std::move(second), law});
    }
}

template <int Dim>
void PointLoads<Dim>::hold_tractions(HeldPlaces<Dim>& places) {
    const auto& conditions = options_.boundary.traction;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const std::size_t n_faces = bodies_.mesh().group(conditions[i].group).faces.size();
        outside_.emplace_back(conditions[i].from_outside ? n_faces : 0, conditions[i].value);
        if (bodies_.traction_hold(i) == TractionHold::cells) continue;
        for (const auto& face : places.faces_of(conditions[i].group)) {
            if (bodies_.traction_hold(i) == TractionHold::frames && !bodies_.is_rigid(face.body)) continue;
            HeldTraction traction{places.of({.body = face.body, .position = face.centroid}),
                                  face.area,
                                  face.body,
                                  i,
                                  face.in_group,
                                  face.normal,
                                  {}};
            if (conditions[i].follows && bodies_.is_finite(face.body))
                for (const Vector<Dim>& corner : face.corners)
                    traction.corners.push_back(places.of({.body = face.body, .position = corner}));
            tractions_.push_back(std::move(traction));
        }
    }
}

/// From here on places are by held point.
template <int Dim>
void PointLoads<Dim>::take_held_points() {
    std::vector<HeldPlace<Dim>*> places;
    for (HeldSpring& spring : springs_) places.insert(places.end(), {&spring.first, &spring.second});
    for (HeldTraction& traction : tractions_) {
        places.push_back(&traction.place);
        for (HeldPlace<Dim>& corner : traction.corners) places.push_back(&corner);
    }
    std::vector<std::int32_t> numbers;
    for (const HeldPlace<Dim>* place : places) numbers.insert(numbers.end(), place->points.begin(), place->points.end());
    sort_unique(numbers);
    for (HeldPlace<Dim>* place : places)
        for (std::int32_t& point : place->points)
            point = static_cast<std::int32_t>(std::ranges::lower_bound(numbers, point) - numbers.begin());
    held_ = HeldPoints<Dim>(std::move(numbers), part_);
}

template <int Dim>
std::vector<HeldPlace<Dim>> PointLoads<Dim>::traction_places(std::size_t condition) const {
    std::vector<std::pair<std::size_t, HeldPlace<Dim>>> by_face;
    for (const HeldTraction& traction : tractions_) {
        if (traction.condition != condition) continue;
        HeldPlace<Dim>& place = by_face.emplace_back(traction.face, traction.place).second;
        for (std::int32_t& point : place.points) point = held_.numbers()[static_cast<std::size_t>(point)];
    }
    std::ranges::sort(by_face, {}, [](const auto& entry) { return entry.first; });
    std::vector<HeldPlace<Dim>> places;
    for (auto& entry : by_face) places.push_back(std::move(entry.second));
    return places;
}

template <int Dim>
void PointLoads<Dim>::check_moments() const {
    for (const BodyMoment<Dim>& moment : options_.moments)
        if (moment.body < 0 || moment.body >= bodies_.mesh().n_bodies() || !moment.moment.allFinite() ||
            !(moment.damping >= 0.0))
            throw BadInput(bodies_.mesh().name + ": a moment on body " + std::to_string(moment.body) +
                           " with a damping of " + number(moment.damping) + " N m s; bodies are counted from 0 to " +
                           std::to_string(bodies_.mesh().n_bodies() - 1) +
                           ", moments are finite, and damping is >= 0. Correct SolidOptions::moments.");
}

template <int Dim>
bool PointLoads<Dim>::damp() const {
    return std::ranges::any_of(springs_, [](const HeldSpring& spring) { return spring.law.damping > 0.0; }) ||
           std::ranges::any_of(moments_, [](const HeldMoment& moment) { return moment.law.damping > 0.0; });
}

template <int Dim>
bool PointLoads<Dim>::do_work() const {
    return !moments_.empty() || !tractions_.empty() || damp();
}

template <int Dim>
double PointLoads<Dim>::energy(std::span<const Vector<Dim>> q) const {
    if (springs_.empty()) return 0.0;
    const auto held = std::move(held_.take({q}).front());
    double energy = 0.0;
    for (const HeldSpring& spring : springs_) {
        const double stretch = (spring.second.at(held) - spring.first.at(held)).norm() - spring.law.length;
        energy += 0.5 * spring.law.stiffness * stretch * stretch;
    }
    return energy;
}

template <int Dim>
void PointLoads<Dim>::add(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt,
                          contact::TakenForce take, const TurnOf& turn_of, std::span<Vector<Dim>> force, double& work) {
    const auto held = held_.take({q_0, q_1});
    add_springs(held[0], held[1], dt, take, force, work);
    work += add_tractions(held[0], held[1], time, turn_of, force);
    for (HeldMoment& moment : moments_) {
        const Middle middle = middle_of(moment, q_0, q_1);
        const AxialVector<Dim> spin =
            spin_at(moment, middle, q_0, q_1, [&](std::int32_t i) -> Vector<Dim> { return q_1[i] - q_0[i]; }) / dt;
        work += add_moment(moment.law, acting(take, moment.spin, spin), middle, q_0, q_1, force);
        moment.spin = spin;
    }
}

template <int Dim>
void PointLoads<Dim>::set_rates(std::span<const Vector<Dim>> q, std::span<const Vector<Dim>> v) {
    if (!damp()) return;
    const auto held = held_.take({q, v});
    for (HeldSpring& spring : springs_)
        spring.rate = rate_of(spring.law, spring.second.at(held[0]) - spring.first.at(held[0]),
                              spring.second.displacement(held[1]) - spring.first.displacement(held[1]));
    for (HeldMoment& moment : moments_) {
        const Middle middle = middle_of(moment, q, q);
        moment.spin = spin_at(moment, middle, q, q, [&](std::int32_t i) -> Vector<Dim> { return v[i]; });
    }
}

template <int Dim>
void PointLoads<Dim>::add_at(std::span<const Vector<Dim>> q, double time, const TurnOf& turn_of,
                             std::span<Vector<Dim>> force) const {
    const auto held = std::move(held_.take({q}).front());
    for (const HeldSpring& spring : springs_) {
        const Vector<Dim> r = spring.second.at(held) - spring.first.at(held);
        push(spring,
             mean_tension(spring.law, r, r) + damping_tension(spring.law, r, spring.rate.value_or(Rate(Rate::Zero()))),
             force);
    }
    add_tractions(held, held, time, turn_of, force);
    for (const HeldMoment& moment : moments_)
        add_moment(moment.law, moment.spin.value_or(AxialVector<Dim>::Zero()), middle_of(moment, q, q), q, q, force);
}

template <int Dim>
auto PointLoads<Dim>::rate_of(const Spring<Dim>& law, const Vector<Dim>& r, const Vector<Dim>& velocity) -> Rate {
    return law.length == 0.0 ? velocity : Rate(r.normalized().dot(velocity) * Rate::Unit(0));
}

/// Along the spring, or in all directions where it has no length.
template <int Dim>
Vector<Dim> PointLoads<Dim>::damping_tension(const Spring<Dim>& law, const Vector<Dim>& r, const Rate& rate) {
    return law.damping * (law.length == 0.0 ? rate : Vector<Dim>(rate[0] * r.normalized()));
}

template <int Dim>
void PointLoads<Dim>::push(const HeldSpring& spring, const Vector<Dim>& tension, std::span<Vector<Dim>> force) const {
    held_.push(spring.first, tension, force);
    held_.push(spring.second, -tension, force);
}

template <int Dim>
void PointLoads<Dim>::add_springs(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double dt,
                                  contact::TakenForce take, std::span<Vector<Dim>> force, double& work) {
    for (HeldSpring& spring : springs_) {
        const Vector<Dim> r_0 = spring.second.at(q_0) - spring.first.at(q_0);
        const Vector<Dim> r_1 = spring.second.at(q_1) - spring.first.at(q_1);
        const Vector<Dim> middle = 0.5 * (r_0 + r_1);
        const Rate rate = rate_of(spring.law, middle, Vector<Dim>((r_1 - r_0) / dt));
        const Vector<Dim> damping = damping_tension(spring.law, middle, acting(take, spring.rate, rate));
        push(spring, mean_tension(spring.law, take == contact::TakenForce::mean ? r_0 : r_1, r_1) + damping, force);
        work -= damping.dot(r_1 - r_0);
        spring.rate = rate;
    }
}

template <int Dim>
Vector<Dim> PointLoads<Dim>::value_of(const HeldTraction& traction, double time) const {
    const TractionCondition<Dim>& condition = options_.boundary.traction[traction.condition];
    if (condition.from_outside) return outside_[traction.condition][traction.face];
    const Vector<Dim> value = condition.history ? condition.history(time, traction.place.rest) : condition.value;
    if (!value.allFinite())
        throw BadInput("traction on '" + condition.group + "': its value at t = " + number(time) +
                       " s is not finite. Correct its value or history.");
    return value;
}

/// Of bodies that turn; those of the others are part of the loads of their cells. Constant within a step, as it begins. Their
/// work [J].
template <int Dim>
double PointLoads<Dim>::add_tractions(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time,
                                      const TurnOf& turn_of, std::span<Vector<Dim>> force) const {
    double work = 0.0;
    for (const HeldTraction& traction : tractions_) {
        if (!traction.corners.empty()) {
            work += add_pressure(traction, value_of(traction, time), q_0, q_1, force);
            continue;
        }
        Vector<Dim> push = traction.area * value_of(traction, time);
        if (options_.boundary.traction[traction.condition].follows) push = turn_of(traction.body) * push;
        held_.push(traction.place, push, force);
        work += push.dot(traction.place.at(q_1) - traction.place.at(q_0));
    }
    return work;
}

/// Of a face of a body of Kinematics::finite: along its area vector in the middle of the step, half of it (in space a third of that
/// of each triangle with the middle of the face) on each corner. Faces share their corners, so that an equal pressure all
/// round has no force and no moment about the mean positions. Its work [J].
template <int Dim>
double PointLoads<Dim>::add_pressure(const HeldTraction& traction, const Vector<Dim>& value,
                                     std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                     std::span<Vector<Dim>> force) const {
    const double along = value.dot(traction.normal);
    if (!((value - along * traction.normal).norm() <= along_normal * value.norm()))
        throw BadInput(
            "traction on '" + options_.boundary.traction[traction.condition].group +
            "': it follows a body of Kinematics::finite, and is not along the normals of its faces: only a pressure "
            "turns with these. Leave follows out, or give a pressure.");
    const auto n = traction.corners.size();
    std::array<Vector<Dim>, most_corners> room_x, room_push;
    std::vector<Vector<Dim>> more_x, more_push;
    if (n > most_corners) {
        more_x.resize(n);
        more_push.resize(n);
    }
    const std::span<Vector<Dim>> x = n > most_corners ? std::span(more_x) : std::span(room_x).first(n);
    const std::span<Vector<Dim>> push = n > most_corners ? std::span(more_push) : std::span(room_push).first(n);
    Vector<Dim> middle = Vector<Dim>::Zero();
    for (std::size_t i = 0; i < n; ++i) {
        x[i] = 0.5 * (traction.corners[i].at(q_0) + traction.corners[i].at(q_1));
        middle += x[i] / static_cast<double>(n);
        push[i] = Vector<Dim>::Zero();
    }
    if constexpr (Dim == 2) {
        push[0] = push[1] = 0.5 * along * area_vector<2>(x);
    } else {
        Vector<Dim> on_middle = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t j = (i + 1) % n;
            const std::array<Vector<Dim>, 3> triangle{middle, x[i], x[j]};
            const Vector<Dim> third = along / 3.0 * area_vector<3>(triangle);
            push[i] += third;
            push[j] += third;
            on_middle += third / static_cast<double>(n);
        }
        for (Vector<Dim>& of_corner : push) of_corner += on_middle;
    }
    double work = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        held_.push(traction.corners[i], push[i], force);
        work += push[i].dot(traction.corners[i].at(q_1) - traction.corners[i].at(q_0));
    }
    return work;
}

/// Calls of_point(point) for the own cells of a body that deforms, or all points of a rigid one.
template <int Dim>
template <class OfPoint>
void PointLoads<Dim>::for_each_here(std::int32_t body, const OfPoint& of_point) const {
    if (const std::int32_t deformable = bodies_.deformable_body(body); deformable >= 0) {
        for (const std::int32_t i : part_.own_cells_of(static_cast<std::size_t>(deformable))) of_point(i);
        return;
    }
    const auto [begin, end] = bodies_.points_of(body);
    for (std::int32_t i = begin; i < end; ++i) of_point(i);
}

/// Of term(point) over the points of a body.
template <int Dim>
template <class Value, class Term>
Value PointLoads<Dim>::sum_of(std::int32_t body, const Value& zero, const Term& term) const {
    if (const std::int32_t deformable = bodies_.deformable_body(body); deformable >= 0)
        return part_.sum_of_body(static_cast<std::size_t>(deformable), zero, term);
    const auto [begin, end] = bodies_.points_of(body);
    return ordered_sum(end - begin, zero,
                       [&, first = begin](std::ptrdiff_t i) { return term(first + static_cast<std::int32_t>(i)); });
}

template <int Dim>
typename PointLoads<Dim>::Middle PointLoads<Dim>::middle_of(const HeldMoment& held, std::span<const Vector<Dim>> q_0,
                                                            std::span<const Vector<Dim>> q_1) const {
    const std::int32_t body = held.law.body;
    const auto at = [&](std::int32_t i) -> Vector<Dim> { return bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]); };
    const Vector<Dim> moment_of_mass = sum_of(body, Vector<Dim>(Vector<Dim>::Zero()),
                                              [&](std::int32_t i) -> Vector<Dim> { return bodies_.masses()[i] * at(i); });
    Middle middle{moment_of_mass / held.mass, Matrix<Dim>::Zero()};
    middle.second_moment = sum_of(body, Matrix<Dim>(Matrix<Dim>::Zero()), [&](std::int32_t i) -> Matrix<Dim> {
        const Vector<Dim> arm = at(i) - middle.centre;
        return bodies_.masses()[i] * arm * arm.transpose();
    });
    return middle;
}

template <int Dim>
template <class Velocity>
AxialVector<Dim> PointLoads<Dim>::spin_at(const HeldMoment& held, const Middle& middle, std::span<const Vector<Dim>> q_0,
                                          std::span<const Vector<Dim>> q_1, const Velocity& velocity) const {
    const AxialVector<Dim> angular =
        sum_of(held.law.body, AxialVector<Dim>(AxialVector<Dim>::Zero()), [&](std::int32_t i) -> AxialVector<Dim> {
            const Vector<Dim> arm = bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]) - middle.centre;
            return bodies_.masses()[i] * moment<Dim>(arm, Vector<Dim>(velocity(i)));
        });
    return spin_of<Dim>(middle.second_moment, angular);
}

/// Forces m alpha × x' that have this moment, x' being arms about the centre in the middle of the step. Their work [J].
template <int Dim>
double PointLoads<Dim>::add_moment(const BodyMoment<Dim>& law, const AxialVector<Dim>& spin, const Middle& middle,
                                   std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                   std::span<Vector<Dim>> force) const {
    const Matrix<Dim> turning =
        hat<Dim>(spin_of<Dim>(middle.second_moment, AxialVector<Dim>(law.moment - law.damping * spin)));
    const auto of_point = [&](std::int32_t i) -> Vector<Dim> {
        const Vector<Dim> arm = bodies_.rest()[i] + 0.5 * (q_0[i] + q_1[i]) - middle.centre;
        return bodies_.masses()[i] * (turning * arm);
    };
    for_each_here(law.body, [&](std::int32_t i) { force[i] += of_point(i); });
    return sum_of(law.body, 0.0, [&](std::int32_t i) { return of_point(i).dot(q_1[i] - q_0[i]); });
}

template <int Dim>
void PointLoads<Dim>::add_stiffness(std::span<const Vector<Dim>> q, std::span<Vector<Dim>> product) const {
    if (springs_.empty()) return;
    const auto held = std::move(held_.take({q}).front());
    for (const HeldSpring& spring : springs_)
        push(spring, spring.law.stiffness * (spring.first.displacement(held) - spring.second.displacement(held)), product);
}

template class PointLoads<2>;
template class PointLoads<3>;

}  // namespace abut::solid
