#include "abut/solid/bond/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "abut/base/decompositions.hpp"
#include "abut/base/disjoint_sets.hpp"
#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/solid/material/orthotropic.hpp"
#include "abut/solid/options/made_features.hpp"

namespace abut::solid {
namespace {

constexpr double least_share_of_stiffness =
    1e-9;  // of a half cell's mean one: directions in which it has none share the jump
// Of two grains against each other [rad]: strains in one frame are off by half the square of it.
constexpr double loose_turn = 0.05;
constexpr double flat = 1e-10;  // of the largest second moment: a cloud of cells has no width in such a direction

template <int Dim>
Matrix<Dim> made_firm(const Matrix<Dim>& stiffness) {
    return stiffness + least_share_of_stiffness / Dim * stiffness.trace() * Matrix<Dim>::Identity();
}

template <int Dim>
std::size_t position_of(const FaceCorrections<Dim>& corrections, BoundaryFace face) {
    const auto at = std::ranges::lower_bound(corrections.faces, face);
    return at != corrections.faces.end() && *at == face ? static_cast<std::size_t>(at - corrections.faces.begin())
                                                        : corrections.faces.size();
}

/// Throws BadInput where a body does not go with the bond that it has.
template <int Dim>
void require_bondable(const Bodies<Dim>& bodies, std::int32_t body, Feature bond) {
    const auto b = static_cast<std::size_t>(body);
    require_together(bodies.mesh().name, "body '" + bodies.mesh().body_names[b] + "'",
                     features_of(bodies.options(), b) | FeatureSet{bond});
}

}  // namespace

template <int Dim>
Bonds<Dim>::Bonds(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames, const RankPart<Dim>& part)
    : bodies_(bodies),
      mesh_(bodies.deformable()),
      ccg_(ccg),
      frames_(frames),
      part_(part),
      places_(bodies.bond_places()),
      share_(places_.size(), 1.0),
      presses_(places_.size(), 0.0),
      loosened_(places_.size(), 0.0),
      normal_stiffness_(places_.size(), 0.0),
      taken_(places_.size(), 0.0),
      opened_(places_.size(), 0.0) {
    check_bodies();
    const std::vector<std::size_t> of_joints = held_joints();
    check_metal(of_joints);
    make_springs();
    faces_.emplace(mesh_, part, places_, of_joints);
    dynamics::agreed(part.ranks(), [&] {
        for (const BondFaces<Dim>* faces : std::array<const BondFaces<Dim>*, 2>{&*faces_, &springs_->faces()})
            for (const BoundaryFace face : faces->own_faces()) check(face);
    });
    make_joints(of_joints);
    check_fracture_energy();
}

template <int Dim>
std::vector<std::size_t> Bonds<Dim>::held_joints() const {
    std::vector<std::size_t> held;
    for (std::size_t p = 0; p < places_.size(); ++p)
        if (is_joint(p)) held.push_back(p);
    return held;
}

/// Interfaces of half cells, of `faces_`.
template <int Dim>
void Bonds<Dim>::make_joints(std::span<const std::size_t> of_joints) {
    of_faces_.clear();
    joints_.clear();
    slope_.clear();
    cells_.clear();
    if (!of_joints.empty()) take_faces();
    for (const std::size_t p : of_joints) append_joint(p);
    take_cells();
    std::vector<std::size_t> own_sides;
    for (std::size_t j = 0; j < joints_.size(); ++j)
        for (std::size_t side = 0; side < 2; ++side)
            if (faces_->is_own(joints_[j].face[side])) own_sides.push_back(2 * j + side);
    sides_ = RankItems(part_.ranks(), std::move(own_sides));
    for (auto* jump : {&jump_, &jump_0_, &jump_1_}) jump->resize(joints_.size());
    pressed_.resize(joints_.size());
    for (auto* of_sides : {&of_side_0_, &of_side_1_}) of_sides->resize(2 * joints_.size());
    for (auto* of_face : {&of_face_, &delta_, &excess_, &gradient_}) of_face->resize(faces_->size());
    delta_here_.resize(faces_->here().size());
    end_.is_known = false;
    end_.q.resize(cells_.size());
    if (ccg_.any_damped()) change_here_.resize(faces_->here().size());
}

/// Springs of the places that are no joints and not gone.
template <int Dim>
void Bonds<Dim>::make_springs() {
    std::vector<std::size_t> of_springs;
    for (std::size_t p = 0; p < places_.size(); ++p)
        if (!is_joint(p) && !is_gone(p)) of_springs.push_back(p);
    springs_ = std::make_unique<BondSprings<Dim>>(bodies_, ccg_, frames_, part_, places_, of_springs, share_, loosened_,
                                                  normal_stiffness_);
}

/// Joints that are broken or loosened become springs, and places that are gone take no part.
template <int Dim>
std::vector<std::size_t> Bonds<Dim>::leave_out_broken() {
    std::vector<std::size_t> become_springs;
    for (const Joint& joint : joints_)
        if (!is_joint(joint.place) && !is_gone(joint.place)) become_springs.push_back(joint.place);
    make_springs();
    const std::vector<std::size_t> of_joints = held_joints();
    if (std::ranges::equal(of_joints, joints_, {}, {}, &Joint::place)) return become_springs;
    faces_.emplace(mesh_, part_, places_, of_joints);
    make_joints(of_joints);
    return become_springs;
}

template <int Dim>
void Bonds<Dim>::soften(std::span<const std::size_t> places, double energy) {
    constexpr double least = 0.1;
    const double held = springs_->pressure_energy(places);
    if (!(held > 0.0) || energy <= 0.0) return;
    for (const std::size_t place : places) normal_stiffness_[place] *= std::max(1.0 - energy / held, least);
    make_springs();
}

template <int Dim>
void Bonds<Dim>::check_bodies() const {
    for (const BondPlace<Dim>& place : places_)
        for (const std::int32_t body : place.bodies) require_bondable(bodies_, body, Feature::bond);
}

/// The return of a cell takes the change of its gradient in a step from its displacements, without delta, and its
/// bonded face as a free one: no balance of energy would show it.
template <int Dim>
void Bonds<Dim>::check_metal(std::span<const std::size_t> of_joints) const {
    for (const std::size_t p : of_joints)
        for (const std::int32_t body : places_[p].bodies) require_bondable(bodies_, body, Feature::small_joint);
}

template <int Dim>
Matrix<Dim> Bonds<Dim>::stiffness_of(BoundaryFace b) const {
    const std::int32_t face = mesh_face(mesh_, b), cell = cell_of(mesh_, b);
    const Material& material = bodies_.deformable_options().materials[static_cast<std::size_t>(mesh_.cell_body[cell])];
    const auto area_of = [&](std::int32_t f) -> Vector<Dim> { return mesh_.face_measure[f] * mesh_.face_normal[f]; };
    const auto with = [&](std::int32_t other) {
        const double measure = mesh_.cell_measure[cell];
        Matrix<Dim> stiffness =
            face_stiffness<Dim>(material.lambda(), material.mu(), measure, area_of(face), area_of(other));
        if (!material.is_isotropic())
            stiffness += DirectedStiffness<Dim>(material).between(area_of(face), area_of(other)) / measure;
        return stiffness;
    };
    Matrix<Dim> stiffness = with(face);
    ccg_.boundary().for_each_answer(b, [&](BoundaryFace answering, const Matrix<Dim>& answer) {
        stiffness += with(mesh_face(mesh_, answering)) * answer;
    });
    return 0.5 / mesh_.face_measure[face] * (stiffness + stiffness.transpose());
}

template <int Dim>
void Bonds<Dim>::take_faces() {
    const BondFaces<Dim>& faces = *faces_;
    const std::vector<double> measure =
        faces.of_owners(1, [&](std::size_t i) { return std::array{mesh_.face_measure[mesh_face(mesh_, faces[i])]}; });
    const std::vector<double> stiffness = faces.of_owners(Dim * Dim, [&](std::size_t i) {
        const Matrix<Dim> of_face = stiffness_of(faces[i]);
        return std::vector<double>(of_face.data(), of_face.data() + Dim * Dim);
    });
    for (std::size_t i = 0; i < faces.size(); ++i)
        of_faces_.push_back(
            {.measure = measure[i],
             .stiffness = Matrix<Dim>(&stiffness[Dim * Dim * i]),
             .cell = faces[i] == no_face ? -1 : cell_of(mesh_, faces[i]),
             .neighbours = faces.is_own(i) ? boundary_of(cell_of(mesh_, faces[i])) : std::vector<BoundaryFace>{}});
}

template <int Dim>
std::vector<BoundaryFace> Bonds<Dim>::boundary_of(std::int32_t cell) const {
    std::vector<BoundaryFace> boundary;
    for (const std::int32_t f : mesh_.cell_faces[cell])
        if (mesh_.is_boundary(f))
            boundary.push_back(
                static_cast<BoundaryFace>(std::ranges::lower_bound(mesh_.boundary_faces, f) - mesh_.boundary_faces.begin()));
    return boundary;
}

template <int Dim>
void Bonds<Dim>::check(BoundaryFace face) const {
    const std::int32_t cell = cell_of(mesh_, face);
    const std::string who = mesh_.name + ": a bonded face of body '" +
                            mesh_.body_names[static_cast<std::size_t>(mesh_.cell_body[cell])] + "' (cell " +
                            std::to_string(mesh_.cell_label[cell]) + ")";
    if (!ccg_.prescribed()[face].isZero(0.0))
        throw BadInput(who + " is held by a support. Leave it out of the support's group, or bond other faces.",
                       {.cell = cell});
    for (const TractionCondition<Dim>& condition : bodies_.deformable_options().boundary.traction) {
        const std::vector<std::int32_t>& loaded = mesh_.group(condition.group).faces;
        const auto is_loaded = [&](BoundaryFace b) { return std::ranges::binary_search(loaded, mesh_face(mesh_, b)); };
        if (is_loaded(face))
            throw BadInput(who + " has a traction on it (group '" + condition.group +
                               "'). Leave it out of that group, or bond other faces.",
                           {.cell = cell});
        if (condition.from_outside && std::ranges::any_of(boundary_of(cell), is_loaded))
            throw BadInput(who + " has a load from outside beside it (group '" + condition.group +
                               "'), on a face that moves with the bond. Leave a cell between both.",
                           {.cell = cell});
    }
}

template <int Dim>
void Bonds<Dim>::append_joint(std::size_t place) {
    Joint joint{};
    joint.place = place;
    joint.area = places_[place].area;
    for (std::size_t side = 0; side < 2; ++side) {
        joint.face[side] = faces_->position_of(places_[place], side);
        joint.slope_of[side] = slope_.size();
        if (const BoundaryFace here = (*faces_)[joint.face[side]]; here != no_face)
            append_slope(joint.face[side], places_[place].position - ccg_.centroid(here));
        joint.slope_end[side] = slope_.size();
    }
    const Matrix<Dim>&k_1 = of_faces_[joint.face[0]].stiffness, k_2 = of_faces_[joint.face[1]].stiffness;
    joint.share[0] = (made_firm<Dim>(k_1) + made_firm<Dim>(k_2)).inverse() * made_firm<Dim>(k_2);
    joint.share[1] = joint.share[0] - Matrix<Dim>::Identity();
    joint.stiffness = joint.share[0].transpose() * k_1 * joint.share[0] + joint.share[1].transpose() * k_2 * joint.share[1];
    joint.normal = places_[place].normal;
    const Vector<Dim> compliance = made_firm<Dim>(joint.stiffness).inverse() * joint.normal;
    joint.normal_stiffness = 1.0 / joint.normal.dot(compliance);
    joint.under_pressure = joint.normal_stiffness * compliance;
    normal_stiffness_[place] = joint.normal_stiffness;
    joints_.push_back(joint);
}

/// The gradient that fits the cells best on which the face depends, along `arm`: exact where they move affinely.
template <int Dim>
void Bonds<Dim>::append_slope(std::size_t face, const Vector<Dim>& arm) {
    const auto of_row = ccg_.cells_of((*faces_)[face]);
    std::vector<std::int32_t> cells(of_row.begin(), of_row.end());
    cells.push_back(of_faces_[face].cell);
    sort_unique(cells);
    Vector<Dim> centre = Vector<Dim>::Zero();
    for (const std::int32_t c : cells) centre += mesh_.cell_centroid[c] / static_cast<double>(cells.size());
    Matrix<Dim> second_moment = Matrix<Dim>::Zero();
    for (const std::int32_t c : cells) {
        const Vector<Dim> x = mesh_.cell_centroid[c] - centre;
        second_moment += x * x.transpose();
    }
    const Vector<Dim> slope = pseudo_inverse(second_moment, flat) * arm;
    for (const std::int32_t c : cells) slope_.push_back({c, slope.dot(mesh_.cell_centroid[c] - centre)});
}

/// Cells that own sides depend on.
template <int Dim>
void Bonds<Dim>::take_cells() {
    for (const std::size_t face : faces_->own()) {
        const auto of_row = ccg_.cells_of((*faces_)[face]);
        cells_.insert(cells_.end(), of_row.begin(), of_row.end());
        cells_.push_back(of_faces_[face].cell);
    }
    sort_unique(cells_);
    if (frames_.any()) in_frames_.resize(static_cast<std::size_t>(mesh_.n_cells()));
}

/// Number of the first body that has a frame in common with each of those that deform.
template <int Dim>
std::vector<std::int32_t> Bonds<Dim>::frame_groups() const {
    DisjointSets held(static_cast<std::size_t>(mesh_.n_bodies()));
    for (std::size_t p = 0; p < places_.size(); ++p)
        if (is_joint(p) && bodies_.have_one_frame(places_[p]))
            held.join(bodies_.deformable_body(places_[p].bodies[0]), bodies_.deformable_body(places_[p].bodies[1]));
    std::vector<std::int32_t> groups;
    for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body) groups.push_back(held.find(body));
    return groups;
}

template <int Dim>
void Bonds<Dim>::find_opening() {
    opening_.clear();
    for (std::size_t first = 0, end = 0; first < places_.size(); first = end) {
        while (end < places_.size() && places_[end].bond == places_[first].bond) ++end;
        bool holds = false, has_opened = false;
        for (std::size_t p = first; p < end; ++p) {
            holds = holds || is_joint(p);
            has_opened = has_opened || share_[p] < 1.0;
        }
        if (holds && has_opened && bodies_.have_one_frame(places_[first])) opening_.push_back(first);
    }
}

template <int Dim>
std::vector<std::size_t> Bonds<Dim>::opening_bodies() const {
    std::vector<std::size_t> bodies;
    for (const std::size_t place : opening_)
        for (const std::int32_t body : places_[place].bodies)
            bodies.push_back(static_cast<std::size_t>(bodies_.deformable_body(body)));
    sort_unique(bodies);
    return bodies;
}

template <int Dim>
std::vector<std::size_t> Bonds<Dim>::loose_bonds(std::span<const Matrix<Dim>> turns) const {
    std::vector<std::size_t> loose;
    for (const std::size_t place : opening_) {
        const auto turn_of = [&](std::size_t side) -> const Matrix<Dim>& {
            return turns[static_cast<std::size_t>(bodies_.deformable_body(places_[place].bodies[side]))];
        };
        if (rotation_angle<Dim>(turn_of(0).transpose() * turn_of(1)) > loose_turn) loose.push_back(places_[place].bond);
    }
    return loose;
}

template <int Dim>
void Bonds<Dim>::loosen(std::span<const std::size_t> bonds) {
    for (std::size_t i = 0; i < joints_.size(); ++i) {
        const std::size_t p = joints_[i].place;
        if (!std::ranges::binary_search(bonds, places_[p].bond)) continue;
        const Vector<Dim> beside = fracture_energy(p) > 0.0 ? beside_pressure(joints_[i], jump_[i]) : jump_[i];
        const Vector<Dim> along = beside.isZero(0.0) ? places_[p].normal : beside;
        loosened_[p] = along.dot(joints_[i].stiffness * along) / along.squaredNorm();
    }
    leave_out_broken();
    find_opening();
}

// In one state, or along a step --------------------------------------------------------------------------------------

template <int Dim>
void Bonds<Dim>::stand_at(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load) {
    if (!any()) return;
    stand_linear(of_cells(q, frames_.end()), load, pressed_at);
    springs_->stand_at(q, load);
}

/// Displacements in these frames of the cells that joints depend on; those of small bodies move as their points do.
template <int Dim>
std::span<const Vector<Dim>> Bonds<Dim>::of_cells(std::span<const Vector<Dim>> q, std::span<const BodyFrame<Dim>> frames) {
    if (!frames_.any() || cells_.empty()) return q;
    frames_.displacement(cells_, q, frames, in_frames_);
    return in_frames_;
}

template <int Dim>
void Bonds<Dim>::stand_linear(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                              PressedSides (*pressed)(double distance)) {
    take_own_sides(u, load, of_side_0_);
    sides_.bring({{as_values<Dim>(of_side_0_), Dim}});
    take_jumps(of_side_0_, jump_);
    look_at_sides([&](std::size_t i) { return pressed(normal_part(joints_[i], jump_[i])); }, pressed_);
    set_corrections(jump_, pressed_, delta_, delta_here_);
}

/// look(i): of joint i.
template <int Dim>
template <class Look>
void Bonds<Dim>::look_at_sides(const Look& look, std::vector<PressedSides>& pressed) const {
    pressed.resize(joints_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i)
        if (share_of(joints_[i]) < 1.0)  // nobody asks for those of whole ones
            pressed[i] = fracture_energy(joints_[i].place) > 0.0 ? look(i) : PressedSides{};
}

template <int Dim>
std::span<const Vector<Dim>> Bonds<Dim>::displacement_at(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    take_own_sides(u, load, of_side_0_);
    sides_.bring({{as_values<Dim>(of_side_0_), Dim}});
    jump_at_.resize(joints_.size());
    delta_at_.resize(delta_.size());
    delta_here_at_.resize(delta_here_.size());
    take_jumps(of_side_0_, jump_at_);
    look_at_sides([&](std::size_t i) { return pressed_at(normal_part(joints_[i], jump_at_[i])); }, pressed_at_);
    set_corrections(jump_at_, pressed_at_, delta_at_, delta_here_at_);
    return delta_here_at_;
}

template <int Dim>
void Bonds<Dim>::follow(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0, std::span<const Vector<Dim>> q_1,
                        const BoundaryLoad<Dim>& load_1) {
    if (!any()) return;
    if (begins_at_end(q_0, load_0))
        std::swap(of_side_0_, of_side_1_);
    else
        take_own_sides(of_cells(q_0, frames_.start()), load_0, of_side_0_);
    take_own_sides(of_cells(q_1, frames_.end()), load_1, of_side_1_);
    keep_end(q_1, load_1);
    sides_.bring({{as_values<Dim>(of_side_0_), Dim}, {as_values<Dim>(of_side_1_), Dim}});
    take_jumps(of_side_0_, jump_0_);
    take_jumps(of_side_1_, jump_1_);
    if (!change_here_.empty()) {
        for (std::size_t i = 0; i < joints_.size(); ++i) jump_[i] = jump_1_[i] - jump_0_[i];
        look_at_sides(
            [&](std::size_t i) {
                const double start = normal_part(joints_[i], jump_0_[i]), end = normal_part(joints_[i], jump_1_[i]);
                return PressedSides{.mean = std::min(end, 0.0) - std::min(start, 0.0)};
            },
            pressed_);
        set_corrections(jump_, pressed_, delta_, change_here_);
    }
    for (std::size_t i = 0; i < joints_.size(); ++i) jump_[i] = 0.5 * (jump_0_[i] + jump_1_[i]);
    look_at_sides(
        [&](std::size_t i) {
            return pressed_along(normal_part(joints_[i], jump_0_[i]), normal_part(joints_[i], jump_1_[i]));
        },
        pressed_);
    set_corrections(jump_, pressed_, delta_, delta_here_);
    springs_->follow(q_0, load_0, q_1, load_1);
}

/// Whether a step begins where the last one ended, to the bit.
template <int Dim>
bool Bonds<Dim>::begins_at_end(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0) const {
    if (!end_.is_known || end_.prescribed.empty() != load_0.displacement.empty()) return false;
    const auto is_same_frame = [](const BodyFrame<Dim>& a, const BodyFrame<Dim>& b) {
        return a.centre == b.centre && a.turn == b.turn;
    };
    if (frames_.any() && !std::ranges::equal(frames_.start(), end_.frames, is_same_frame)) return false;
    for (std::size_t i = 0; i < end_.prescribed.size(); ++i)
        if (load_0.displacement[static_cast<std::size_t>(faces_->own_faces()[i])] != end_.prescribed[i]) return false;
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (q_0[static_cast<std::size_t>(cells_[i])] != end_.q[i]) return false;
    return true;
}

template <int Dim>
void Bonds<Dim>::keep_end(std::span<const Vector<Dim>> q_1, const BoundaryLoad<Dim>& load_1) {
    end_.is_known = true;
    for (std::size_t i = 0; i < cells_.size(); ++i) end_.q[i] = q_1[static_cast<std::size_t>(cells_[i])];
    if (frames_.any()) end_.frames.assign(frames_.end().begin(), frames_.end().end());
    end_.prescribed.clear();
    if (load_1.displacement.empty()) return;
    for (const BoundaryFace face : faces_->own_faces())
        end_.prescribed.push_back(load_1.displacement[static_cast<std::size_t>(face)]);
}

template <int Dim>
void Bonds<Dim>::take_own_sides(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load,
                                std::vector<Vector<Dim>>& of_sides) {
    for (const std::size_t face : faces_->own()) of_face_[face] = ccg_.face_displacement((*faces_)[face], u, load);
    for (const std::size_t i : sides_.own()) {
        const Joint& joint = joints_[i / 2];
        const std::size_t side = i % 2, face = joint.face[side];
        const Vector<Dim>& origin = u[of_faces_[face].cell];
        Vector<Dim> displacement = of_face_[face];
        for (std::size_t k = joint.slope_of[side]; k < joint.slope_end[side]; ++k)
            displacement += slope_[k].weight * (u[slope_[k].cell] - origin);
        of_sides[i] = displacement;
    }
}

template <int Dim>
void Bonds<Dim>::take_jumps(std::span<const Vector<Dim>> of_sides, std::vector<Vector<Dim>>& jump) const {
    for (std::size_t p = 0; p < joints_.size(); ++p) jump[p] = of_sides[2 * p + 1] - of_sides[2 * p];
}

template <int Dim>
void Bonds<Dim>::set_corrections(std::span<const Vector<Dim>> jump, std::span<const PressedSides> pressed,
                                 std::vector<Vector<Dim>>& delta, std::vector<Vector<Dim>>& here) const {
    for (Vector<Dim>& of_face : delta) of_face.setZero();
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const double share = share_of(joint);
        const Vector<Dim> borne =
            share < 1.0 ? Vector<Dim>(share * jump[p] + (1.0 - share) * pressed[p].mean * joint.under_pressure) : jump[p];
        for (std::size_t side = 0; side < 2; ++side) {
            const std::size_t face = joint.face[side];
            delta[face] += joint.area / of_faces_[face].measure * (joint.share[side] * borne);
        }
    }
    for (std::size_t i = 0; i < here.size(); ++i) here[i] = delta[faces_->here()[i]];
}

template <int Dim>
FaceCorrections<Dim> Bonds<Dim>::corrections(const FaceCorrections<Dim>& of_contact) {
    if (!any()) return of_contact;
    of_others_ = springs_->corrections(of_contact);
    return merged_.of(of_others_, own_corrections());
}

template <int Dim>
std::span<const BodyPush<Dim>> Bonds<Dim>::pushes(std::span<const BodyPush<Dim>> others) {
    return any() ? springs_->pushes(others) : others;
}

template <int Dim>
double Bonds<Dim>::energy() const {
    if (!any()) return 0.0;
    double energy = springs_->energy();
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const double share = share_of(joint);
        energy += 0.5 * share * joint.area * jump_[p].dot(joint.stiffness * jump_[p]);
        if (share < 1.0)
            energy += 0.5 * (1.0 - share) * joint.area * joint.normal_stiffness * pressed_[p].mean * pressed_[p].mean;
    }
    for (std::size_t i = 0; i < of_faces_.size(); ++i)
        energy -= 0.5 * of_faces_[i].measure * delta_[i].dot(of_faces_[i].stiffness * delta_[i]);
    return energy;
}

/// dV/dû of a face without what others push it with: the points that they push have no part in the corrections.
template <int Dim>
Vector<Dim> Bonds<Dim>::bulk_gradient(const BondedFace& of_cell, BoundaryFace face) const {
    Vector<Dim> gradient = ccg_.boundary_gradient(face);
    if (of_others_.faces.empty()) return gradient;
    const std::size_t n = of_others_.faces.size();
    if (const std::size_t i = position_of(of_others_, face); i < n) gradient -= of_others_.energy_gradient[i];
    if (of_others_.moment.empty()) return gradient;
    const std::int32_t f = mesh_face(mesh_, face);
    const Vector<Dim> spread = mesh_.face_measure[f] / mesh_.cell_measure[of_cell.cell] * mesh_.face_normal[f];
    for (const BoundaryFace neighbour : of_cell.neighbours)
        if (const std::size_t i = position_of(of_others_, neighbour); i < n) gradient -= of_others_.moment[i] * spread;
    return gradient;
}

template <int Dim>
void Bonds<Dim>::take_excess() {
    for (const std::size_t i : faces_->own()) {
        const BondedFace& face = of_faces_[i];
        const BoundaryFace b = (*faces_)[i];
        Vector<Dim> of_face = bulk_gradient(face, b);
        ccg_.boundary().for_each_answer(b, [&](BoundaryFace answering, const Matrix<Dim>& answer) {
            of_face += answer.transpose() * bulk_gradient(face, answering);
        });
        excess_[i] = of_face / face.measure - face.stiffness * delta_[i];
    }
    faces_->items().bring({{as_values<Dim>(excess_), Dim}});
}

/// dV/dDelta of a place [N].
template <int Dim>
Vector<Dim> Bonds<Dim>::push_of(const Joint& joint, const Vector<Dim>& jump, const PressedSides& pressed) const {
    const double share = share_of(joint);
    const Vector<Dim> of_first = joint.share[0].transpose() * excess_[joint.face[0]],
                      of_second = joint.share[1].transpose() * excess_[joint.face[1]];
    const Vector<Dim> whole = joint.stiffness * jump + of_first + of_second;
    if (share == 1.0) return joint.area * whole;
    const double pressure =
        joint.normal_stiffness * pressed.gradient + pressed.slope * joint.under_pressure.dot(of_first + of_second);
    return joint.area * (share * whole + (1.0 - share) * pressure * joint.normal);
}

/// Each place pushes both faces, and the cells on whose slope it depends beside that.
template <int Dim>
void Bonds<Dim>::push_faces(std::span<Vector<Dim>> gradient) {
    for (Vector<Dim>& of_face : gradient_) of_face.setZero();
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const Vector<Dim> push = push_of(joint, jump_[p], pressed_[p]);
        for (std::size_t side = 0; side < 2; ++side) {
            const Vector<Dim> on_side = side == 0 ? Vector<Dim>(-push) : push;
            gradient_[joint.face[side]] += on_side;
            for (std::size_t i = joint.slope_of[side]; i < joint.slope_end[side]; ++i)
                gradient[static_cast<std::size_t>(slope_[i].cell)] += slope_[i].weight * on_side;
        }
    }
}

template <int Dim>
void Bonds<Dim>::add_gradient(std::span<Vector<Dim>> gradient) {
    if (joints_.empty()) return;
    take_excess();
    push_faces(gradient);
    const BoundaryReconstruction<Dim>& rows = ccg_.boundary();
    for (const std::size_t i : faces_->here()) {
        const std::int32_t b = number_of((*faces_)[i]);
        for (std::int32_t k = rows.offsets[b]; k < rows.offsets[b + 1]; ++k)
            gradient[static_cast<std::size_t>(rows.cells[k])] += rows.weights[k].transpose() * gradient_[i];
    }
}

template <int Dim>
double Bonds<Dim>::work_of_loads(const BoundaryLoad<Dim>& start, const BoundaryLoad<Dim>& end) const {
    const std::vector<double> of_faces = faces_->of_owners(1, [&](std::size_t i) {
        const auto b = static_cast<std::size_t>((*faces_)[i]);
        return std::array{gradient_[i].dot(end.displacement[b] - start.displacement[b])};
    });
    return std::accumulate(of_faces.begin(), of_faces.end(), 0.0);
}

template <int Dim>
void Bonds<Dim>::save(StateWriter& state) const {
    state.put_all(std::span<const double>(share_));
    std::vector<double> strengths;
    for (const BondPlace<Dim>& place : places_) strengths.push_back(place.strength);
    state.put_all(std::span<const double>(strengths));
    state.put_all(std::span<const double>(loosened_));
    state.put_all(std::span<const double>(taken_));
    state.put_all(std::span<const double>(opened_));
    state.put_all(std::span<const double>(presses_));
    state.put_all(std::span<const double>(normal_stiffness_));
}

template <int Dim>
void Bonds<Dim>::restore(StateReader& state) {
    const std::vector<double> share = state.get_all<double>();
    if (share.size() != share_.size())
        throw BadInput(mesh_.name + ": the saved state has " + std::to_string(share.size()) +
                           " places that are bonded, and here are " + std::to_string(share_.size()) +
                           ". Restore it where bonds are the same.",
                       {.value = static_cast<double>(share.size()), .allowed = static_cast<double>(share_.size())});
    std::array<std::vector<double>, 6> others;
    for (std::vector<double>& of_places : others) {
        of_places = state.get_all<double>();
        if (of_places.size() != share.size())
            throw BadInput(mesh_.name + ": the saved state of its bonds is damaged. Take another checkpoint.");
    }
    auto& [strengths, loosened, taken, opened, presses, normal_stiffness] = others;
    share_ = share;
    loosened_ = loosened;
    taken_ = taken;
    opened_ = opened;
    presses_ = presses;
    leave_out_broken();
    normal_stiffness_ = normal_stiffness;
    make_springs();
    find_opening();
    for (std::size_t p = 0; p < places_.size(); ++p) places_[p].strength = strengths[p];  // drawn once
}

template <int Dim>
void Bonds<Dim>::break_all() {
    for (std::size_t p = 0; p < places_.size(); ++p)
        if (std::isfinite(places_[p].strength)) share_[p] = presses_[p] = 0.0;
    leave_out_broken();
}

template class Bonds<2>;
template class Bonds<3>;

}  // namespace abut::solid
