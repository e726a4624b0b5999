#include "abut/solid/load/outside_loads.hpp"

#include <algorithm>

#include "abut/base/error.hpp"
#include "abut/solid/part/state_of_vectors.hpp"

namespace abut::solid {
namespace {

/// Own faces of a group whose bodies do not turn, as boundary faces in the mesh of the bodies that deform: where bodies are
/// rigid, their faces are numbered otherwise there, in the same order.
template <int Dim>
std::vector<BoundaryFace> faces_from_outside(const Bodies<Dim>& bodies, const GroupFaces<Dim>& faces,
                                             const std::string& name) {
    const std::vector<std::int32_t>&in_mesh = bodies.mesh().group(name).faces,
          &deformable = bodies.deformable().group(name).faces;
    const std::vector<std::int32_t>& all = bodies.deformable().boundary_faces;
    std::vector<BoundaryFace> boundary;
    for (const std::int32_t face : faces.own()) {
        const auto in_group = std::ranges::lower_bound(in_mesh, face) - in_mesh.begin();
        const auto at = std::ranges::lower_bound(all, deformable[static_cast<std::size_t>(in_group)]);
        boundary.push_back(static_cast<BoundaryFace>(at - all.begin()));
    }
    return boundary;
}

/// Places of own faces, held by points of the part.
template <int Dim>
std::vector<HeldPlace<Dim>> own_places(const RankPart<Dim>& part, const GroupFaces<Dim>& faces,
                                       const std::vector<HeldPlace<Dim>>& of_all) {
    std::vector<HeldPlace<Dim>> places;
    for (const std::int32_t number : faces.numbers()) {
        HeldPlace<Dim>& place = places.emplace_back(of_all[static_cast<std::size_t>(number)]);
        for (std::int32_t& point : place.points) point = part.position_of(point);
    }
    return places;
}

}  // namespace

template <int Dim>
OutsideLoads<Dim>::OutsideLoads(const Bodies<Dim>& bodies, const RankPart<Dim>& part, Ccg<Dim>& ccg, const Loads<Dim>& loads,
                                PointTractions<Dim>& tractions)
    : bodies_(bodies), part_(part), ccg_(ccg), loads_(loads), tractions_(tractions) {
    const auto& conditions = bodies.options().boundary.traction;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        if (!conditions[i].from_outside) continue;
        Group group{conditions[i].group, i, GroupFaces<Dim>(bodies, part, conditions[i].group), {}, {}, {}, {}};
        if (bodies.traction_hold(i) == TractionHold::cells)
            group.boundary = faces_from_outside(bodies, group.faces, group.name);
        else
            group.places = own_places(part, group.faces, tractions.places_of(i));
        group.traction.assign(group.faces.own().size(), conditions[i].value);
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
    Group& changed = *dynamics::agreed(part_.ranks(), [&] { return &known_group(name, traction); });
    require_same(changed);
    set_all(changed, changed.faces.gather(traction));
}

/// The group of that name, if it can take these tractions.
template <int Dim>
auto OutsideLoads<Dim>::known_group(const std::string& name, std::span<const Vector<Dim>> traction) -> Group& {
    Group& known = groups_[static_cast<std::size_t>(&group(name) - groups_.data())];
    const std::span<const std::int32_t> faces = known.faces.own();
    if (traction.size() != faces.size())
        throw BadInput("traction on '" + name + "': " + std::to_string(traction.size()) + " are given for " +
                           std::to_string(faces.size()) + " faces. Give one per face of the group" +
                           (part_.is_whole() ? "." : " that this rank has."),
                       {.value = static_cast<double>(traction.size()), .allowed = static_cast<double>(faces.size())});
    for (std::size_t i = 0; i < traction.size(); ++i)
        if (!traction[i].allFinite())
            throw BadInput("traction on '" + name + "': that on its face " + std::to_string(i) +
                               ", counted from 0, is not finite. Nothing has changed; give finite tractions.",
                           {.face_1 = faces[i]});
    return known;
}

/// Else ranks would take tractions of one group for those of another.
template <int Dim>
void OutsideLoads<Dim>::require_same(const Group& group) const {
    if (part_.is_whole()) return;
    const double mine[] = {static_cast<double>(group.condition)};
    for (const double other : part_.ranks().gather(mine))
        if (other != mine[0])
            throw BadInput("tractions: ranks give those on '" + group.name + "' and on '" +
                           bodies_.options().boundary.traction[static_cast<std::size_t>(other)].group +
                           "' at the same time. Give the same group on all of them; nothing has changed.");
}

/// Copies of faces take what their owners have.
template <int Dim>
void OutsideLoads<Dim>::set_all(Group& group, std::span<const Vector<Dim>> of_all) {
    group.traction = group.faces.own_of(of_all);
    if (bodies_.traction_hold(group.condition) == TractionHold::cells)
        ccg_.set_traction(group.name, group.faces.here_of(of_all));
    else
        tractions_.set(group.condition, of_all);
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
    return bodies_.mesh().face_measure[static_cast<std::size_t>(group.faces.own()[face])];
}

/// `held` of bodies that do not turn [J].
template <int Dim>
double OutsideLoads<Dim>::held(const Group& group, std::span<const Vector<Dim>> traction, std::span<const Vector<Dim>> q,
                               const BoundaryLoad<Dim>& load) const {
    if (bodies_.traction_hold(group.condition) != TractionHold::cells) return 0.0;
    const std::vector<Vector<Dim>> displacement = displacement_under(group, q, load);
    return group.faces.fold(0.0, [&](std::size_t i) { return area(group, i) * traction[i].dot(displacement[i]); });
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
        work_.steps = group.faces.fold(work_.steps, [&](std::size_t i) {
            Vector<Dim> push = area(group, i) * group.traction[i];
            const std::int32_t cell = bodies_.mesh().face_cells[static_cast<std::size_t>(group.faces.own()[i])][0];
            if (follows) push = turn_of(bodies_.mesh().cell_body[static_cast<std::size_t>(cell)]) * push;
            return push.dot(motion[i]);
        });
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
        put_all<Dim>(state, group.faces.gather(group.traction));
        put_all<Dim>(state, group.faces.gather(group.acting));
    }
}

template <int Dim>
void OutsideLoads<Dim>::restore(StateReader& state) {
    work_.steps = state.get<double>();
    work_.changes = state.get<double>();
    if (ccg_.is_warm()) work_.heat = state.get<double>();
    for (Group& group : groups_) {
        std::vector<Vector<Dim>> of_all(group.faces.n_all());
        take_all<Dim>(state, of_all);
        set_all(group, of_all);
        take_all<Dim>(state, of_all);
        group.acting = group.faces.own_of(of_all);
    }
}

template <int Dim>
void OutsideLoads<Dim>::take_over(const OutsideLoads& before, std::span<const std::int32_t> old_faces) {
    work_ = before.work_;
    for (Group& group : groups_) {
        const auto from = std::ranges::find(before.groups_, group.name, &Group::name);
        if (from == before.groups_.end()) continue;
        const std::span<const std::int32_t> faces = group.faces.own(), of_before = from->faces.own();
        std::vector<Vector<Dim>> traction = group.traction;
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const std::int32_t old_face = old_faces[static_cast<std::size_t>(faces[i])];
            const auto at = std::ranges::lower_bound(of_before, old_face);
            if (at == of_before.end() || *at != old_face) continue;
            const auto k = static_cast<std::size_t>(at - of_before.begin());
            traction[i] = from->traction[k];
            group.acting[i] = from->acting[k];
        }
        set_traction(group.name, traction);
    }
}

template class OutsideLoads<2>;
template class OutsideLoads<3>;

}  // namespace abut::solid
