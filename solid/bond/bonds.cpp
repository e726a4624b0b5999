#include "abut/solid/bond/bonds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "abut/base/decompositions.hpp"
#include "abut/base/disjoint_sets.hpp"
#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/solid/material/orthotropic.hpp"
#include "abut/solid/options/made_features.hpp"

namespace abut::solid {
namespace {

// Directions in which a half cell has no stiffness, as at the rim of a body, share the jump.
constexpr double least_share_of_stiffness = 1e-9;  // of its mean one
constexpr double least_of_largest = 0.01;          // its stiffness in any direction, over the largest
// Of two grains against each other [rad]: strains in one frame are off by half the square of it.
constexpr double loose_turn = 0.05;
constexpr double flat = 1e-10;  // of the largest second moment: a cloud of cells has no width in such a direction

/// A stiffness that is not much less in any direction than in others. Sides of a place that are softer slide off by much
/// more than what presses on them, where the normal is off the stiff direction by little.
template <int Dim>
Matrix<Dim> made_firm(const Matrix<Dim>& stiffness) {
    Matrix<Dim> firm = stiffness + least_share_of_stiffness / Dim * stiffness.trace() * Matrix<Dim>::Identity();
    const auto [values, directions] = symmetric_eigen(stiffness);
    const double least = least_of_largest * values[Dim - 1];
    for (int i = 0; i < Dim && values[i] < least; ++i) {
        const Vector<Dim> direction = directions.col(i);
        firm += (least - values[i]) * direction * direction.transpose();
    }
    return firm;
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
      pressed_energy_(places_.size(), 0.0),
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
            check(faces->own_faces());
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

/// Springs of the places that are no joints and not broken.
template <int Dim>
void Bonds<Dim>::make_springs() {
    std::vector<std::size_t> of_springs;
    for (std::size_t p = 0; p < places_.size(); ++p)
        if (!is_joint(p) && !is_broken(p)) of_springs.push_back(p);
    springs_ = std::make_unique<BondSprings<Dim>>(bodies_, ccg_, frames_, part_, places_, of_springs, share_, loosened_,
                                                  normal_stiffness_);
}

/// Joints that are loosened become springs, and places that are broken take no part.
template <int Dim>
void Bonds<Dim>::leave_out_broken() {
    make_springs();
    const std::vector<std::size_t> of_joints = held_joints();
    if (std::ranges::equal(of_joints, joints_, {}, {}, &Joint::place)) return;
    faces_.emplace(mesh_, part_, places_, of_joints);
    make_joints(of_joints);
}

template <int Dim>
void Bonds<Dim>::hand_over(double energy) {
    double pressed = 0.0;
    for (const BondChange& change : broke_pressed_) pressed += places_[change.place].area * change.pressed;
    const double part = handed_over_part(pressed, energy);
    for (const BondChange& change : broke_pressed_) pressed_energy_[change.place] = part * change.pressed;
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
void Bonds<Dim>::check(std::span<const BoundaryFace> bonded) const {
    const auto who = [&](BoundaryFace face) {
        const std::int32_t cell = cell_of(mesh_, face);
        return mesh_.name + ": a bonded face of body '" + mesh_.body_names[static_cast<std::size_t>(mesh_.cell_body[cell])] +
               "' (cell " + std::to_string(mesh_.cell_label[cell]) + ")";
    };
    for (const BoundaryFace face : bonded)
        if (!ccg_.prescribed()[face].isZero(0.0))
            throw BadInput(who(face) + " is held by a support. Leave it out of the support's group, or bond other faces.",
                           {.cell = cell_of(mesh_, face)});
    const std::vector<TractionCondition<Dim>>& conditions = bodies_.deformable_options().boundary.traction;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const TractionCondition<Dim>& condition = conditions[i];
        // A program outside may load what comes to be free, and what it loads moves as points do.
        if (bodies_.options().boundary.traction[i].from_outside && bodies_.traction_hold(i) == TractionHold::points)
            continue;
        const std::vector<std::int32_t>& loaded = mesh_.group(condition.group).faces;
        const auto is_loaded = [&](BoundaryFace b) { return std::ranges::binary_search(loaded, mesh_face(mesh_, b)); };
        for (const BoundaryFace face : bonded) {
            if (is_loaded(face))
                throw BadInput(who(face) + " has a traction on it (group '" + condition.group +
                                   "'). Leave it out of that group, or bond other faces.",
                               {.cell = cell_of(mesh_, face)});
            if (condition.from_outside && std::ranges::any_of(boundary_of(cell_of(mesh_, face)), is_loaded))
                throw BadInput(who(face) + " has a load from outside beside it (group '" + condition.group +
                                   "'), on a face that moves with the bond. Leave a cell between both.",
                               {.cell = cell_of(mesh_, face)});
        }
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

template class Bonds<2>;
template class Bonds<3>;

}  // namespace abut::solid
