#include "abut/solid/load/point_tractions.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"

namespace abut::solid {
namespace {

constexpr double along_normal = 1e-12;    // what a pressure may have across, over all of it
constexpr std::size_t most_corners = 12;  // of a face, without memory of its own

/// d(v_f)/dx_i of a face whose normal sees its corners run to the left: half of its area vector, in space a third of
/// that of each triangle with the middle of the face.
template <int Dim>
void set_volume_slopes(std::span<const Vector<Dim>> x, std::span<Vector<Dim>> slope) {
    if constexpr (Dim == 2) {
        slope[0] = slope[1] = 0.5 * area_vector<2>(x);
    } else {
        const std::size_t n = x.size();
        const auto share = 1.0 / static_cast<double>(n);
        Vector<Dim> middle = Vector<Dim>::Zero(), on_middle = Vector<Dim>::Zero();
        for (std::size_t i = 0; i < n; ++i) {
            middle += share * x[i];
            slope[i] = Vector<Dim>::Zero();
        }
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t j = (i + 1) % n;
            const std::array<Vector<Dim>, 3> triangle{middle, x[i], x[j]};
            const Vector<Dim> third = area_vector<3>(triangle) / 3.0;
            slope[i] += third;
            slope[j] += third;
            on_middle += share * third;
        }
        for (Vector<Dim>& of_corner : slope) of_corner += on_middle;
    }
}

/// d(a_f . d)/dx_i.
template <int Dim>
Vector<Dim> area_slope(std::span<const Vector<Dim>> x, std::size_t i, const Vector<Dim>& d) {
    if constexpr (Dim == 2) {
        return (i == 0 ? 1.0 : -1.0) * Vector<2>(d[1], -d[0]);
    } else {
        const std::size_t n = x.size();
        return 0.5 * moment<3>(Vector<3>(x[(i + 1) % n] - x[(i + n - 1) % n]), d);
    }
}

/// Shares of corners in the force of a pressure on a face at rest.
template <int Dim>
std::vector<double> corner_weights(std::span<const Vector<Dim>> corners) {
    std::vector<Vector<Dim>> slopes(corners.size());
    set_volume_slopes<Dim>(corners, slopes);
    const Vector<Dim> area = area_vector<Dim>(corners);
    std::vector<double> weights;
    for (const Vector<Dim>& slope : slopes) weights.push_back(slope.dot(area) / area.squaredNorm());
    return weights;
}

}  // namespace

template <int Dim>
PointTractions<Dim>::PointTractions(const Bodies<Dim>& bodies, HeldPlaces<Dim>& places, const HeldPoints<Dim>& held)
    : bodies_(bodies), held_(held) {
    const auto& conditions = bodies.options().boundary.traction;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        std::vector<Vector<Dim>>& from_outside = outside_.emplace_back();
        if (bodies_.traction_hold(i) == TractionHold::cells) continue;
        const auto faces = places.faces_of(conditions[i].group);
        if (conditions[i].from_outside) from_outside.assign(faces.size(), conditions[i].value);
        for (const auto& face : faces) {
            if (bodies_.traction_hold(i) == TractionHold::frames && !bodies_.is_rigid(face.body)) continue;
            Held traction{face.place, face.area, face.body, i, face.in_group, face.normal, {}, {}};
            if (conditions[i].follows && bodies_.is_finite(face.body)) {
                for (const Vector<Dim>& corner : face.corners)
                    traction.corners.push_back(places.of({.body = face.body, .position = corner}));
                traction.weights = corner_weights<Dim>(face.corners);
            }
            tractions_.push_back(std::move(traction));
        }
    }
}

template <int Dim>
std::vector<HeldPlace<Dim>*> PointTractions<Dim>::places() {
    std::vector<HeldPlace<Dim>*> places;
    for (Held& traction : tractions_) {
        places.push_back(&traction.place);
        for (HeldPlace<Dim>& corner : traction.corners) places.push_back(&corner);
    }
    return places;
}

template <int Dim>
std::vector<HeldPlace<Dim>> PointTractions<Dim>::places_of(std::size_t condition) const {
    std::vector<std::pair<std::size_t, HeldPlace<Dim>>> by_face;
    for (const Held& traction : tractions_) {
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
Vector<Dim> PointTractions<Dim>::value_of(const Held& traction, double time) const {
    const TractionCondition<Dim>& condition = bodies_.options().boundary.traction[traction.condition];
    if (condition.from_outside) return outside_[traction.condition][traction.face];
    const Vector<Dim> value = condition.history ? condition.history(time, traction.place.rest) : condition.value;
    if (!value.allFinite())
        throw BadInput("traction on '" + condition.group + "': its value at t = " + number(time) +
                       " s is not finite. Correct its value or history.");
    return value;
}

template <int Dim>
void PointTractions<Dim>::add(const PointStep<Dim>& step, std::span<Vector<Dim>> force, double& work) {
    work += add_all(step.q_0.held, step.q_1.held, step.time, step.turn_of, force);
}

template <int Dim>
void PointTractions<Dim>::add_at(const ByPoint<Dim>& q, double time, const TurnOf<Dim>& turn_of,
                                 std::span<Vector<Dim>> force) const {
    add_all(q.held, q.held, time, turn_of, force);
}

/// Adds tractions of bodies that turn; those of the others are part of the loads of their cells. Constant within a
/// step, as it begins. Their work [J].
template <int Dim>
double PointTractions<Dim>::add_all(Points q_0, Points q_1, double time, const TurnOf<Dim>& turn_of,
                                    std::span<Vector<Dim>> force) const {
    double work = 0.0;
    for (const Held& traction : tractions_) {
        if (!traction.corners.empty()) {
            work += add_pressure(traction, value_of(traction, time), q_0, q_1, force);
            continue;
        }
        Vector<Dim> push = traction.area * value_of(traction, time);
        if (bodies_.options().boundary.traction[traction.condition].follows) push = turn_of(traction.body) * push;
        held_.push(traction.place, push, force);
        work += push.dot(traction.place.at(q_1) - traction.place.at(q_0));
    }
    return work;
}

/// In the middle of the step. Its work [J].
template <int Dim>
double PointTractions<Dim>::add_pressure(const Held& traction, const Vector<Dim>& value, Points q_0, Points q_1,
                                         std::span<Vector<Dim>> force) const {
    const double along = value.dot(traction.normal);
    if (!((value - along * traction.normal).norm() <= along_normal * value.norm()))
        throw BadInput(
            "traction on '" + bodies_.options().boundary.traction[traction.condition].group +
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
    Vector<Dim> off = 0.5 * (traction.place.at(q_0) + traction.place.at(q_1));  // x_f - c_f
    for (std::size_t i = 0; i < n; ++i) {
        x[i] = 0.5 * (traction.corners[i].at(q_0) + traction.corners[i].at(q_1));
        off -= traction.weights[i] * x[i];
    }
    const Vector<Dim> area = area_vector<Dim>(std::span<const Vector<Dim>>(x));
    set_volume_slopes<Dim>(x, push);
    double work = 0.0;
    const auto act = [&](const HeldPlace<Dim>& place, const Vector<Dim>& on_place) {
        held_.push(place, on_place, force);
        work += on_place.dot(place.at(q_1) - place.at(q_0));
    };
    act(traction.place, along * area);
    for (std::size_t i = 0; i < n; ++i)
        act(traction.corners[i], along * (push[i] - traction.weights[i] * area + area_slope<Dim>(x, i, off)));
    return work;
}

template class PointTractions<2>;
template class PointTractions<3>;

}  // namespace abut::solid
