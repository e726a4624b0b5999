#include "abut/solid/load/outside_loads.hpp"

#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/solid/part/state_of_matrix.hpp"

namespace abut::solid {
namespace {

/// Boundary faces, in the mesh of the bodies that deform, of a group whose bodies do not turn.
template <int Dim>
std::vector<BoundaryFace> faces_from_outside(const mesh::Mesh<Dim>& part, const std::string& name) {
    std::vector<BoundaryFace> boundary;
    for (const std::int32_t face : part.group(name).faces) {
        const auto at = std::ranges::lower_bound(part.boundary_faces, face);
        boundary.push_back(static_cast<BoundaryFace>(at - part.boundary_faces.begin()));
    }
    return boundary;
}

}  // namespace

template <int Dim>
OutsideLoads<Dim>::OutsideLoads(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const Loads<Dim>& loads,
                                PointTractions<Dim>& tractions)
    : bodies_(bodies), ccg_(ccg), loads_(loads), tractions_(tractions) {
    const auto& conditions = bodies.options().boundary.traction;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        if (!conditions[i].from_outside) continue;
        Group group{conditions[i].group, i, bodies.mesh().group(conditions[i].group).faces, {}, {}, {}, {}};
        group.places = tractions.places_of(i);
        if (group.places.empty()) group.boundary = faces_from_outside(bodies.deformable(), group.name);
        group.traction.assign(group.faces.size(), conditions[i].value);
        group.acting = group.traction;
        groups_.push_back(std::move(group));
    }
}

template <int Dim>
const typename OutsideLoads<Dim>::Group& OutsideLoads<Dim>::group(const std::string& name) const {
    const auto found = std::ranges::find(groups_, name, &Group::name);
    if (found != groups_.end()) return *found;
    std::string known;
    for (const Group& group : groups_) known += (known.empty() ? "'" : ", '") + group.name + "'";
    throw BadInput(bodies_.mesh().name + ": no traction from outside acts on '" + name + "'; there " +
                   (known.empty() ? "is none" : "are " + known) +
                   ". Give a TractionCondition of this group with from_outside.");
}

template <int Dim>
void OutsideLoads<Dim>::set_traction(const std::string& name, std::span<const Vector<Dim>> traction) {
    Group& changed = groups_[static_cast<std::size_t>(&group(name) - groups_.data())];
    if (traction.size() != changed.faces.size())
        throw BadInput(
            "traction on '" + name + "': " + std::to_string(traction.size()) + " are given for " +
                std::to_string(changed.faces.size()) + " faces. Give one per face of the group.",
            {.value = static_cast<double>(traction.size()), .allowed = static_cast<double>(changed.faces.size())});
    for (std::size_t i = 0; i < traction.size(); ++i)
        if (!traction[i].allFinite())
            throw BadInput("traction on '" + name + "': that on its face " + std::to_string(i) +
                               ", counted from 0, is not finite. Nothing has changed; give finite tractions.",
                           {.face_1 = changed.faces[i]});
    changed.traction.assign(traction.begin(), traction.end());
    if (changed.places.empty())
        ccg_.set_traction(name, traction);
    else
        tractions_.set(changed.condition, traction);
}

template <int Dim>
std::vector<Vector<Dim>> OutsideLoads<Dim>::displacement_under(const Group& group, std::span<const Vector<Dim>> q,
                                                               const BoundaryLoad<Dim>& load) const {
    std::vector<Vector<Dim>> displacement;
    for (const BoundaryFace b : group.boundary) displacement.push_back(ccg_.face_displacement(b, q, load));
    for (const HeldPlace<Dim>& place : group.places) displacement.push_back(place.at(q) - place.rest);
    return displacement;
}

template <int Dim>
std::vector<Vector<Dim>> OutsideLoads<Dim>::displacement(const Group& group, std::span<const Vector<Dim>> q) const {
    return displacement_under(group, q, loads_.end());
}

template <int Dim>
std::vector<Vector<Dim>> OutsideLoads<Dim>::velocity(const Group& group, std::span<const Vector<Dim>> of_points) const {
    return displacement_under(group, of_points, ccg_.load_free());
}

template <int Dim>
std::vector<Vector<Dim>> OutsideLoads<Dim>::motion_under(const Group& group, std::span<const Vector<Dim>> q_0,
                                                         std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_0,
                                                         const BoundaryLoad<Dim>& load_1) const {
    const std::vector<Vector<Dim>> start = displacement_under(group, q_0, load_0);
    std::vector<Vector<Dim>> motion = displacement_under(group, q_1, load_1);
    for (std::size_t i = 0; i < motion.size(); ++i) motion[i] -= start[i];
    return motion;
}

template <int Dim>
std::vector<Vector<Dim>> OutsideLoads<Dim>::motion(const Group& group, std::span<const Vector<Dim>> q_0,
                                                   std::span<const Vector<Dim>> q_1, double time, double dt) const {
    return motion_under(group, q_0, q_1, ccg_.load_at(time, time), ccg_.load_at(time + dt, time));
}

template <int Dim>
double OutsideLoads<Dim>::area(const Group& group, std::size_t face) const {
    return bodies_.mesh().face_measure[static_cast<std::size_t>(group.faces[face])];
}

/// `held` of bodies that do not turn [J].
template <int Dim>
double OutsideLoads<Dim>::held(const Group& group, std::span<const Vector<Dim>> traction, std::span<const Vector<Dim>> q,
                               const BoundaryLoad<Dim>& load) const {
    if (group.boundary.empty()) return 0.0;
    const std::vector<Vector<Dim>> displacement = displacement_under(group, q, load);
    double sum = 0.0;
    for (std::size_t i = 0; i < displacement.size(); ++i) sum += area(group, i) * traction[i].dot(displacement[i]);
    return sum;
}

template <int Dim>
double OutsideLoads<Dim>::held_change(std::span<const Vector<Dim>> q) const {
    double change = 0.0;
    for (const Group& group : groups_)
        change += held(group, group.traction, q, loads_.end()) - held(group, group.acting, q, loads_.start());
    return change;
}

template <int Dim>
double OutsideLoads<Dim>::held_change_of_heat(std::span<const Vector<Dim>> q) const {
    double change = 0.0;
    for (const Group& group : groups_)
        change += held(group, group.acting, q, loads_.end()) - held(group, group.acting, q, loads_.start());
    return change;
}

template <int Dim>
void OutsideLoads<Dim>::add_step(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                 const TurnOf<Dim>& turn_of) {
    for (Group& group : groups_) {
        group.acting = group.traction;
        const bool follows = bodies_.options().boundary.traction[group.condition].follows;
        const std::vector<Vector<Dim>> motion = motion_under(group, q_0, q_1, loads_.start(), loads_.end());
        for (std::size_t i = 0; i < motion.size(); ++i) {
            Vector<Dim> push = area(group, i) * group.traction[i];
            const std::int32_t cell = bodies_.mesh().face_cells[static_cast<std::size_t>(group.faces[i])][0];
            if (follows) push = turn_of(bodies_.mesh().cell_body[static_cast<std::size_t>(cell)]) * push;
            work_.steps += push.dot(motion[i]);
        }
    }
}

template <int Dim>
OutsideWork OutsideLoads<Dim>::work(std::span<const Vector<Dim>> q) const {
    OutsideWork work = work_;
    for (const Group& group : groups_) work.held += held(group, group.acting, q, loads_.end());
    return work;
}

template <int Dim>
void OutsideLoads<Dim>::save(StateWriter& state) const {
    state.put(work_.steps);
    state.put(work_.changes);
    if (ccg_.is_warm()) state.put(work_.heat);
    for (const Group& group : groups_) {
        put_all<Dim>(state, group.traction);
        put_all<Dim>(state, group.acting);
    }
}

template <int Dim>
void OutsideLoads<Dim>::restore(StateReader& state) {
    work_.steps = state.get<double>();
    work_.changes = state.get<double>();
    if (ccg_.is_warm()) work_.heat = state.get<double>();
    for (Group& group : groups_) {
        std::vector<Vector<Dim>> traction = group.traction;
        take_all<Dim>(state, traction);
        set_traction(group.name, traction);
        take_all<Dim>(state, group.acting);
    }
}

template <int Dim>
void OutsideLoads<Dim>::take_over(const OutsideLoads& before, std::span<const std::int32_t> old_faces) {
    work_ = before.work_;
    for (Group& group : groups_) {
        const auto from = std::ranges::find(before.groups_, group.name, &Group::name);
        if (from == before.groups_.end()) continue;
        std::vector<Vector<Dim>> traction = group.traction;
        for (std::size_t i = 0; i < group.faces.size(); ++i) {
            const auto at = std::ranges::lower_bound(from->faces, old_faces[static_cast<std::size_t>(group.faces[i])]);
            if (at == from->faces.end() || *at != old_faces[static_cast<std::size_t>(group.faces[i])]) continue;
            const auto k = static_cast<std::size_t>(at - from->faces.begin());
            traction[i] = from->traction[k];
            group.acting[i] = from->acting[k];
        }
        set_traction(group.name, traction);
    }
}

template class OutsideLoads<2>;
template class OutsideLoads<3>;

}  // namespace abut::solid
