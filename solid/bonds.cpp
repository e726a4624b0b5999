#include "abut/solid/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "abut/base/decompositions.hpp"
#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"

namespace abut::solid {
namespace {

constexpr double least_stiffness = 1e-9;  // of a half cell's mean one: directions in which it has none share the jump
constexpr double flat = 1e-10;            // of the largest second moment: a cloud of cells has no width in such a direction

template <int Dim>
Matrix<Dim> made_firm(const Matrix<Dim>& stiffness) {
    return stiffness + least_stiffness / Dim * stiffness.trace() * Matrix<Dim>::Identity();
}

template <int Dim>
std::size_t position_of(const FaceCorrections<Dim>& corrections, BoundaryFace face) {
    const auto at = std::ranges::lower_bound(corrections.faces, face);
    return at != corrections.faces.end() && *at == face ? static_cast<std::size_t>(at - corrections.faces.begin())
                                                        : corrections.faces.size();
}

}  // namespace

template <int Dim>
Bonds<Dim>::Bonds(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const BodyFrames<Dim>& frames)
    : bodies_(bodies), mesh_(bodies.deformable()), ccg_(ccg), places_(bodies.bond_places()), share_(places_.size(), 1.0) {
    check_bodies();
    const mesh::Mesh<Dim>& mesh = bodies.mesh();
    std::vector<BoundaryFace> here;  // in the numbering of the bodies that deform
    std::int32_t n_here = 0;
    for (const BoundaryFace b : boundary_faces(mesh))
        here.push_back(bodies.is_rigid(mesh.cell_body[cell_of(mesh, b)]) ? no_face : BoundaryFace{n_here++});
    std::vector<std::size_t> of_springs, of_joints;
    std::vector<std::array<BoundaryFace, 2>> faces;
    for (std::size_t p = 0; p < places_.size(); ++p) {
        bool turns = false;
        for (std::size_t side = 0; side < 2; ++side) {
            const BoundaryFace face = places_[p].faces[side];
            turns = turns || bodies.turns(mesh.cell_body[cell_of(mesh, face)]);
        }
        faces.push_back(
            {here[static_cast<std::size_t>(places_[p].faces[0])], here[static_cast<std::size_t>(places_[p].faces[1])]});
        for (const BoundaryFace face : faces.back()) check(face);
        (turns ? of_springs : of_joints).push_back(p);
    }
    springs_ = std::make_unique<BondSprings<Dim>>(bodies, ccg, frames, places_, faces, of_springs, share_);
    for (const std::size_t p : of_joints) face_numbers_.insert(face_numbers_.end(), faces[p].begin(), faces[p].end());
    sort_unique(face_numbers_);
    for (const BoundaryFace face : face_numbers_) faces_.push_back(bonded_face(face));
    for (const std::size_t p : of_joints) append_joint(p, faces[p]);
    for (auto* jump : {&jump_, &jump_0_, &jump_1_}) jump->resize(joints_.size());
    for (auto* of_face : {&of_face_, &delta_, &gradient_}) of_face->resize(faces_.size());
    check_fracture_energy();
}

template <int Dim>
void Bonds<Dim>::check_bodies() const {
    const mesh::Mesh<Dim>& mesh = bodies_.mesh();
    for (const BondPlace<Dim>& place : places_)
        for (const BoundaryFace face : place.faces) {
            const std::int32_t body = mesh.cell_body[cell_of(mesh, face)];
            const std::string who = mesh.name + ": body '" + mesh.body_names[static_cast<std::size_t>(body)] + "' ";
            if (bodies_.is_rigid(body))
                throw BadInput(who +
                               "is rigid and cannot be bonded. Let it deform (Kinematics::small, ::floating or ::finite), "
                               "or join it by SolidOptions::springs.");
            // The cells behind a bond would yield as if nothing pulled there, and no balance of energy would show it.
            const Material& material = bodies_.options().materials[static_cast<std::size_t>(body)];
            if (material.law == MaterialLaw::j2)
                throw BadInput(who +
                               "yields (law = \"j2\") and cannot be bonded: its cells behind the bond would not feel it as "
                               "they yield. Take another material, or leave the bond out.");
        }
}

template <int Dim>
auto Bonds<Dim>::bonded_face(BoundaryFace b) const -> BondedFace {
    const std::int32_t face = mesh_face(mesh_, b), cell = cell_of(mesh_, b);
    BondedFace bonded{b, cell, mesh_.face_measure[face], Matrix<Dim>::Zero(), boundary_of(cell)};
    const Material& material = bodies_.deformable_options().materials[static_cast<std::size_t>(mesh_.cell_body[cell])];
    const auto area_of = [&](std::int32_t f) -> Vector<Dim> { return mesh_.face_measure[f] * mesh_.face_normal[f]; };
    const auto with = [&](std::int32_t other) {
        return face_stiffness<Dim>(material.lambda(), material.mu(), mesh_.cell_measure[cell], area_of(face),
                                   area_of(other));
    };
    Matrix<Dim> stiffness = with(face);
    ccg_.boundary().for_each_answer(b, [&](BoundaryFace answering, const Matrix<Dim>& answer) {
        stiffness += with(mesh_face(mesh_, answering)) * answer;
    });
    bonded.stiffness = 0.5 / bonded.measure * (stiffness + stiffness.transpose());
    return bonded;
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
void Bonds<Dim>::append_joint(std::size_t place, std::array<BoundaryFace, 2> faces) {
    Joint joint{};
    joint.place = place;
    joint.area = places_[place].area;
    for (std::size_t side = 0; side < 2; ++side) {
        joint.face[side] =
            static_cast<std::size_t>(std::ranges::lower_bound(face_numbers_, faces[side]) - face_numbers_.begin());
        joint.slope_of[side] = slope_.size();
        append_slope(faces_[joint.face[side]], places_[place].position - ccg_.centroid(faces[side]));
        joint.slope_end[side] = slope_.size();
    }
    const Matrix<Dim>&k_1 = faces_[joint.face[0]].stiffness, k_2 = faces_[joint.face[1]].stiffness;
    joint.share[0] = (made_firm<Dim>(k_1) + made_firm<Dim>(k_2)).inverse() * made_firm<Dim>(k_2);
    joint.share[1] = joint.share[0] - Matrix<Dim>::Identity();
    joint.stiffness = joint.share[0].transpose() * k_1 * joint.share[0] + joint.share[1].transpose() * k_2 * joint.share[1];
    joints_.push_back(joint);
}

/// The gradient that fits the cells best on which the face depends, along `arm`: exact where they move affinely.
template <int Dim>
void Bonds<Dim>::append_slope(const BondedFace& face, const Vector<Dim>& arm) {
    const auto of_row = ccg_.cells_of(face.face);
    std::vector<std::int32_t> cells(of_row.begin(), of_row.end());
    cells.push_back(face.cell);
    sort_unique(cells);
    Vector<Dim> centre = Vector<Dim>::Zero();
    for (const std::int32_t c : cells) centre += mesh_.cell_centroid[c] / static_cast<double>(cells.size());
    Matrix<Dim> second_moment = Matrix<Dim>::Zero();
    for (const std::int32_t c : cells) {
        const Vector<Dim> x = mesh_.cell_centroid[c] - centre;
        second_moment += x * x.transpose();
    }
    const Vector<Dim> slope = pseudo_inverse(Eigen::MatrixXd(second_moment), flat) * arm;
    for (const std::int32_t c : cells) slope_.push_back({c, slope.dot(mesh_.cell_centroid[c] - centre)});
}

template <int Dim>
bool Bonds<Dim>::any_breaks() const {
    return std::ranges::any_of(bodies_.options().bonds, [](const Bond& bond) { return std::isfinite(bond.strength); });
}

// In one state, or along a step --------------------------------------------------------------------------------------

template <int Dim>
void Bonds<Dim>::stand_at(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load) {
    if (!any()) return;
    stand_linear(q, load);
    springs_->stand_at(q, load);
}

/// Cells of small bodies move as their points do.
template <int Dim>
void Bonds<Dim>::stand_linear(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    take_jumps(u, load, jump_);
    set_corrections();
}

template <int Dim>
void Bonds<Dim>::follow(std::span<const Vector<Dim>> q_0, const BoundaryLoad<Dim>& load_0, std::span<const Vector<Dim>> q_1,
                        const BoundaryLoad<Dim>& load_1) {
    if (!any()) return;
    take_jumps(q_0, load_0, jump_0_);
    take_jumps(q_1, load_1, jump_1_);
    for (std::size_t i = 0; i < joints_.size(); ++i) jump_[i] = 0.5 * (jump_0_[i] + jump_1_[i]);
    set_corrections();
    springs_->follow(q_0, load_0, q_1, load_1);
}

template <int Dim>
void Bonds<Dim>::take_jumps(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load, std::vector<Vector<Dim>>& jump) {
    for (std::size_t i = 0; i < faces_.size(); ++i) of_face_[i] = ccg_.face_displacement(faces_[i].face, u, load);
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const auto at = [&](std::size_t side) {
            const Vector<Dim>& origin = u[faces_[joint.face[side]].cell];
            Vector<Dim> displacement = of_face_[joint.face[side]];
            for (std::size_t i = joint.slope_of[side]; i < joint.slope_end[side]; ++i)
                displacement += slope_[i].weight * (u[slope_[i].cell] - origin);
            return displacement;
        };
        jump[p] = at(1) - at(0);
    }
}

template <int Dim>
void Bonds<Dim>::set_corrections() {
    for (Vector<Dim>& delta : delta_) delta.setZero();
    for (std::size_t p = 0; p < joints_.size(); ++p)
        for (std::size_t side = 0; side < 2; ++side) {
            const std::size_t face = joints_[p].face[side];
            const double weight = share_of(joints_[p]) * joints_[p].area / faces_[face].measure;
            delta_[face] += weight * (joints_[p].share[side] * jump_[p]);
        }
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
    for (std::size_t p = 0; p < joints_.size(); ++p)
        energy += 0.5 * share_of(joints_[p]) * joints_[p].area * jump_[p].dot(joints_[p].stiffness * jump_[p]);
    for (std::size_t i = 0; i < faces_.size(); ++i)
        energy -= 0.5 * faces_[i].measure * delta_[i].dot(faces_[i].stiffness * delta_[i]);
    return energy;
}

/// dV/dû of a face without what others push it with: the points that they push have no part in the corrections.
template <int Dim>
Vector<Dim> Bonds<Dim>::bulk_gradient(const BondedFace& of_cell, BoundaryFace face) const {
    Vector<Dim> gradient = ccg_.boundary_gradient(face);
    if (of_others_.faces.empty()) return gradient;
    const std::size_t n = of_others_.faces.size();
    if (const std::size_t i = position_of(of_others_, face); i < n) gradient -= of_others_.energy_gradient[i];
    const std::int32_t f = mesh_face(mesh_, face);
    const Vector<Dim> spread = mesh_.face_measure[f] / mesh_.cell_measure[of_cell.cell] * mesh_.face_normal[f];
    for (const BoundaryFace neighbour : of_cell.neighbours)
        if (const std::size_t i = position_of(of_others_, neighbour); i < n) gradient -= of_others_.moment[i] * spread;
    return gradient;
}

template <int Dim>
void Bonds<Dim>::add_gradient(std::span<Vector<Dim>> gradient) {
    if (joints_.empty()) return;
    std::vector<Vector<Dim>> excess(faces_.size());  // of the face's traction over that of its half cell alone [Pa]
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const BondedFace& face = faces_[i];
        Vector<Dim> of_face = bulk_gradient(face, face.face);
        ccg_.boundary().for_each_answer(face.face, [&](BoundaryFace answering, const Matrix<Dim>& answer) {
            of_face += answer.transpose() * bulk_gradient(face, answering);
        });
        excess[i] = of_face / face.measure - face.stiffness * delta_[i];
        gradient_[i].setZero();
    }
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Joint& joint = joints_[p];
        const Vector<Dim> push = share_of(joint) * joint.area *
                                 (joint.stiffness * jump_[p] + joint.share[0].transpose() * excess[joint.face[0]] +
                                  joint.share[1].transpose() * excess[joint.face[1]]);
        for (std::size_t side = 0; side < 2; ++side) {
            const Vector<Dim> on_side = side == 0 ? Vector<Dim>(-push) : push;
            gradient_[joint.face[side]] += on_side;
            for (std::size_t i = joint.slope_of[side]; i < joint.slope_end[side]; ++i)
                gradient[static_cast<std::size_t>(slope_[i].cell)] += slope_[i].weight * on_side;
        }
    }
    const BoundaryReconstruction<Dim>& rows = ccg_.boundary();
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const std::int32_t b = number_of(faces_[i].face);
        for (std::int32_t k = rows.offsets[b]; k < rows.offsets[b + 1]; ++k)
            gradient[static_cast<std::size_t>(rows.cells[k])] += rows.weights[k].transpose() * gradient_[i];
    }
}

template <int Dim>
double Bonds<Dim>::work_of_loads(const BoundaryLoad<Dim>& start, const BoundaryLoad<Dim>& end) const {
    double work = 0.0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
        const auto b = static_cast<std::size_t>(faces_[i].face);
        work += gradient_[i].dot(end.displacement[b] - start.displacement[b]);
    }
    return work;
}

// Breaking -----------------------------------------------------------------------------------------------------------

/// `traction` of the place as if it were whole, `stiffness` of both half cells in its direction.
template <int Dim>
void Bonds<Dim>::append_change(std::size_t place, const Vector<Dim>& traction, double stiffness, const Vector<Dim>& normal,
                               std::vector<BondChange>& changes) const {
    if (share_[place] == 0.0 || traction.dot(normal) <= 0.0) return;
    const double share = share_of_bond(bodies_.options().bonds[places_[place].bond], traction.norm(), stiffness);
    if (share < share_[place]) changes.push_back({place, share_[place], share});
}

template <int Dim>
std::vector<BondChange> Bonds<Dim>::changes() const {
    std::vector<BondChange> changes;
    for (std::size_t p = 0; p < joints_.size(); ++p) {
        const Vector<Dim> traction = joints_[p].stiffness * jump_1_[p];
        const double energy = traction.dot(jump_1_[p]);
        if (energy > 0.0)
            append_change(joints_[p].place, traction, traction.squaredNorm() / energy, places_[joints_[p].place].normal,
                          changes);
    }
    springs_->for_each_traction(
        [&](std::size_t place, const Vector<Dim>& traction, double stiffness, const Vector<Dim>& normal) {
            append_change(place, traction, stiffness, normal, changes);
        });
    std::ranges::sort(changes, {}, &BondChange::place);
    return changes;
}

template <int Dim>
void Bonds<Dim>::set_shares(std::span<const BondChange> changes, When when) {
    for (const auto& [place, start, end] : changes)
        share_[place] = when == When::start ? start : when == When::end ? end : 0.5 * (start + end);
}

/// A bond that opens must take more than half cells give back as it does, straight at least: at the rim of a bond they may give way along the
/// face without bearing anything.
template <int Dim>
void Bonds<Dim>::check_fracture_energy() const {
    const auto check = [&](std::size_t p, double stiffness) {
        const Bond& bond = bodies_.options().bonds[places_[p].bond];
        if (bond.fracture_energy == 0.0) return;
        const double held = energy_at_strength(bond, stiffness);
        if (bond.fracture_energy > held) return;
        const mesh::Mesh<Dim>& mesh = bodies_.mesh();
        const auto body_at = [&](std::size_t side) {
            return "'" + mesh.body_names[static_cast<std::size_t>(mesh.cell_body[cell_of(mesh, places_[p].faces[side])])] +
                   "'";
        };
        throw BadInput(mesh_.name + ": the bond of " + body_at(0) + " and " + body_at(1) + " has a fracture energy of " +
                           number(bond.fracture_energy) + " J/m^2, but at its strength the half cells beside it hold " +
                           number(held) + " J/m^2, and it would take these at once. Make cells there " +
                           number(std::ceil(10.0 * held / bond.fracture_energy) / 10.0 + 0.1) +
                           " times smaller or more, or leave fracture_energy out.",
                       {.value = bond.fracture_energy, .allowed = held});
    };
    for (const Joint& joint : joints_) {
        const Vector<Dim>& normal = places_[joint.place].normal;
        check(joint.place, (joint.stiffness * normal).squaredNorm() / normal.dot(joint.stiffness * normal));
    }
    springs_->for_each_stiffness(check);
}

template <int Dim>
void Bonds<Dim>::save(StateWriter& state) const {
    state.put_all(std::span<const double>(share_));
}

template <int Dim>
void Bonds<Dim>::restore(StateReader& state) {
    const std::vector<double> share = state.get_all<double>();
    if (share.size() != share_.size())
        throw BadInput(mesh_.name + ": the saved state has " + std::to_string(share.size()) +
                           " places that are bonded, and here are " + std::to_string(share_.size()) +
                           ". Restore it where bonds are the same.",
                       {.value = static_cast<double>(share.size()), .allowed = static_cast<double>(share_.size())});
    share_ = share;
}

template class Bonds<2>;
template class Bonds<3>;

}  // namespace abut::solid
