// What a solid tells of itself: contact, bodies, and the way between its points and the cells of the mesh.
#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/solid/bodies.hpp"
#include "abut/solid/body_cells.hpp"
#include "abut/solid/body_rotation.hpp"
#include "abut/solid/bonds.hpp"
#include "abut/solid/contact_driver.hpp"
#include "abut/solid/loads.hpp"
#include "abut/solid/local_levels.hpp"
#include "abut/solid/point_loads.hpp"
#include "abut/solid/rank_part.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

constexpr double contact_margin = 0.85;      // of 2/omega_max
constexpr double finite_margin = 2.0 / 3.0;  // the same: 0.6 of it with the 0.9 that runs take

template <int Dim>
std::vector<double> as_numbers(const std::vector<Vector<Dim>>& vectors) {
    std::vector<double> numbers;
    for (const Vector<Dim>& vector : vectors) numbers.insert(numbers.end(), vector.begin(), vector.end());
    return numbers;
}

/// Contact of a law; null where contact is by another one.
template <class OfLaw, int Dim>
const OfLaw* by_law(const ContactDriver<Dim>& driver) {
    const auto contact = driver.contact();
    const auto* found = std::get_if<std::reference_wrapper<const OfLaw>>(&contact);
    return found ? &found->get() : nullptr;
}

}  // namespace

// Contact ------------------------------------------------------------------------------------------------------------

template <int Dim>
void Solid<Dim>::evaluate_contact(std::span<const double> q) {
    const auto u = state_here(q);
    frames_->stand_at(of_cells(u));
    contact_->evaluate(u, time_);
}

template <int Dim>
ContactField Solid<Dim>::contact_field(std::span<const double> q) {
    if (contact_) {
        evaluate_contact(q);
        return contact_->field();
    }
    const std::size_t n = mesh_.boundary_faces.size();
    return {std::vector<double>(n, 0.0), std::vector<double>(n, std::numeric_limits<double>::infinity())};
}

template <int Dim>
std::vector<TouchingPair<Dim>> Solid<Dim>::touching_pairs(std::span<const double> q, double gap) {
    if (!contact_) return {};
    evaluate_contact(q);
    return contact_->touching_pairs(gap);
}

template <int Dim>
std::vector<ActingPair<Dim>> Solid<Dim>::acting_pairs(std::span<const double> q) {
    if (!contact_) return {};
    evaluate_contact(q);
    std::vector<ActingPair<Dim>> acting;
    for (const contact::PairStep<Dim>& pair : contact_->pairs())
        if (pair.force != Vector<Dim>::Zero())
            acting.push_back({contact_->mesh_boundary(pair.face_1), contact_->mesh_boundary(pair.face_2), pair.normal,
                              pair.gap_1, pair.area, pair.normal_force, pair.force, pair.friction, pair.slip});
    return acting;
}

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> Solid<Dim>::contact_patches() const {
    return contact_ ? contact_->patches() : std::vector<dynamics::ContactPatch<Dim>>{};
}

template <int Dim>
double Solid<Dim>::compression() const {
    return contact_ ? contact_->compression() : 0.0;
}

template <int Dim>
void Solid<Dim>::require_depth() const {
    if (!contact_ || contact_->pairs().empty()) return;
    const auto pair = std::ranges::max_element(contact_->pairs(), {}, &contact::PairStep<Dim>::compression);
    const double deepest = pair->compression, limit = options_.contact->compression_limit;
    if (!(deepest > limit)) return;
    const auto name_of = [&](contact::Face face) -> std::string {
        const BoundaryFace boundary = contact_->mesh_boundary(face);
        if (boundary == no_face) return "an obstacle";
        const std::int32_t of_mesh = mesh_face(mesh_, boundary);
        std::string name = "the face of body '" + mesh_.body_names[mesh_.cell_body[mesh_.face_cells[of_mesh][0]]] + "' at (";
        for (int i = 0; i < Dim; ++i) name += (i > 0 ? ", " : "") + number(mesh_.face_centroid[of_mesh][i]);
        return name + ") m";
    };
    throw TooDeep(
        mesh_.name + ": " + name_of(pair->face_1) + " and " + name_of(pair->face_2) + " are pressed " + number(deepest) +
            " times the depth of their cells into each other, " + number(limit) +
            " is allowed (compression_limit). Load them less, or refine the mesh at the contact.",
        {.face_1 = number_of(pair->face_1), .face_2 = number_of(pair->face_2), .value = deepest, .allowed = limit});
}

template <int Dim>
Vector<Dim> Solid<Dim>::obstacle_force(std::size_t obstacle) const {
    if (obstacle >= options_.obstacles.size())
        throw Misuse("solid: the force on obstacle " + std::to_string(obstacle) + " is asked for, but there are " +
                     std::to_string(options_.obstacles.size()) + " obstacles, counted from 0.");
    return contact_->obstacles().force(obstacle);
}

template <int Dim>
std::span<const BodyImpulse<Dim>> Solid<Dim>::contact_impulses() const {
    return contact_ ? contact_->impulses() : std::span<const BodyImpulse<Dim>>{};
}

template <int Dim>
const contact::Contact<Dim>* Solid<Dim>::contact() const {
    return contact_ ? by_law<contact::Contact<Dim>>(*contact_) : nullptr;
}

template <int Dim>
const contact::NodalContact<Dim>* Solid<Dim>::nodal_contact() const {
    return contact_ ? by_law<contact::NodalContact<Dim>>(*contact_) : nullptr;
}

template <int Dim>
double Solid<Dim>::skin() const {
    return contact_ ? contact_->skin() : 0.0;
}

template <int Dim>
contact::ContactReport Solid<Dim>::contact_report() const {
    return contact_ ? contact_->report() : contact::ContactReport{};
}

template <int Dim>
dynamics::ContactCounts Solid<Dim>::contact_counts() const {
    const contact::ContactReport report = contact_report();
    dynamics::ContactCounts counts{.active_pairs = report.active_pairs, .events = report.events};
    if (contact_) {
        const contact::FrictionFigures& friction = contact_->friction();
        counts.dissipated = report.friction_dissipated;
        counts.friction_energy = friction.energy;
        counts.sticking_faces = report.sticking_faces;
        counts.sliding_faces = report.sliding_faces;
    }
    return counts;
}

template <int Dim>
double Solid<Dim>::plastic_strain(std::int32_t cell) const {
    const std::int32_t deformable = bodies_->deformable_cell(cell).first;
    return deformable < 0 ? 0.0 : ccg_.plastic_strain(deformable);
}

template <int Dim>
double Solid<Dim>::out_of_plane_stress(std::int32_t cell) const {
    if constexpr (Dim == 3) return 0.0;
    const std::int32_t deformable = bodies_->deformable_cell(cell).first;
    if (deformable < 0) return 0.0;
    if (const auto of_law = ccg_.out_of_plane_stress(deformable)) return *of_law;
    const auto body = static_cast<std::size_t>(mesh_.cell_body[static_cast<std::size_t>(cell)]);
    return options_.materials[body].poisson * stress(cell).trace();
}

template <int Dim>
std::int32_t Solid<Dim>::cell_of_contact_face(std::int64_t face) const {
    if (!contact_ || face < 0 || face > std::numeric_limits<std::int32_t>::max()) return -1;
    const BoundaryFace boundary = contact_->mesh_boundary(contact::Face{static_cast<std::int32_t>(face)});
    return boundary == no_face ? -1 : cell_of(mesh_, boundary);
}

template <int Dim>
std::vector<contact::BlindCorner<Dim>> Solid<Dim>::blind_corners() const {
    return contact_ ? contact_->blind_corners() : std::vector<contact::BlindCorner<Dim>>{};
}

template <int Dim>
std::optional<contact::EdgePair<Dim>> Solid<Dim>::unseen_edges() const {
    return contact_ ? contact_->unseen_edges() : std::nullopt;
}

// Bodies and cells ----------------------------------------------------------------------------------------------------

template <int Dim>
std::span<const double> Solid<Dim>::inverse_mass() const {
    return part_->inverse_masses();
}

template <int Dim>
std::span<const double> Solid<Dim>::masses() const {
    return part_->masses();
}

template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::rest_positions() const {
    return part_->rest();
}

template <int Dim>
std::span<const std::int32_t> Solid<Dim>::body_of_points() const {
    return part_->body_of_points();
}

template <int Dim>
std::vector<double> Solid<Dim>::rotations(std::span<const double> q) const {
    const auto u = as_vectors<Dim>(q);
    std::vector<Vector<Dim>> kept;
    const auto of_part = bodies_->any_rigid() ? part_->filled(u, kept) : u;
    return bodies_->of_bodies(rotation_->angles(u), [&](std::size_t rigid) {
        return rotation_angle<Dim>(nearest_rotation<Dim>(bodies_->rigid().place(rigid, of_part).map));
    });
}

template <int Dim>
std::vector<double> Solid<Dim>::local_rotations(std::span<const double> q) {
    static_cast<void>(potential(q));  // leaves the displacement gradients of this state behind
    const mesh::Mesh<Dim>& part = bodies_->deformable();
    std::vector<double> largest(static_cast<std::size_t>(part.n_bodies()), 0.0);
    for (const std::int32_t c : part_->own_cells()) {
        if (bodies_->is_finite(bodies_->body_of_points()[static_cast<std::size_t>(c)])) continue;
        double& of_body = largest[static_cast<std::size_t>(part.cell_body[c])];
        of_body = larger(of_body, 0.5 * axial<Dim>(ccg_.displacement_gradient(c)).norm());
    }
    for (double& of_body : largest) of_body = ranks().largest(of_body);
    return bodies_->of_bodies(largest, [](std::size_t) { return 0.0; });
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::cell_displacement(std::span<const double> q) const {
    std::vector<Vector<Dim>> kept;
    return bodies_->of_cells(part_->filled(as_vectors<Dim>(q), kept));
}

template <int Dim>
Matrix<Dim> Solid<Dim>::displacement_gradient(std::int32_t cell, std::span<const double> q) const {
    const auto [deformable, body] = bodies_->deformable_cell(cell);
    if (deformable >= 0) {
        const Matrix<Dim>& turn = frames_->end()[static_cast<std::size_t>(body)].turn;
        return turn * ccg_.displacement_gradient(deformable) + turn - Matrix<Dim>::Identity();
    }
    for (std::size_t i = 0; i < bodies_->rigid().size(); ++i)
        if (bodies_->rigid().mesh_body(i) == mesh_.cell_body[cell])
            return bodies_->rigid().place_by(i, own_points_of(i, as_vectors<Dim>(q))).map - Matrix<Dim>::Identity();
    return Matrix<Dim>::Zero();
}

/// The part of q that belongs to an own rigid body.
template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::own_points_of(std::size_t rigid, std::span<const Vector<Dim>> q) const {
    constexpr std::size_t n = RigidBodies<Dim>::points_per_body;
    const auto own = part_->own_rigid();
    const auto found = std::ranges::find(own, static_cast<std::int32_t>(rigid));
    if (found == own.end())
        throw Misuse("solid: the displacement gradient of rigid body " + std::to_string(bodies_->rigid().mesh_body(rigid)) +
                     " is asked for on a rank that does not own its points. Ask the one that does (Solid::own_cells).");
    return q.subspan(part_->own_cells().size() + n * static_cast<std::size_t>(found - own.begin()), n);
}

template <int Dim>
OwnCells Solid<Dim>::own_cells() const {
    OwnCells own;
    std::vector<bool> is_own(mesh_.cell_body.size(), false), is_own_body(mesh_.body_names.size(), false);
    for (const std::int32_t c : part_->own_cells()) is_own[bodies_->mesh_cell(c)] = true;
    for (const std::int32_t i : part_->own_rigid()) is_own_body[bodies_->rigid().mesh_body(i)] = true;
    std::int32_t deformable = 0, begin = 0;  // bodies that deform so far; where a body begins in the whole mesh
    for (std::int32_t body = 0; body < mesh_.n_bodies(); ++body) {
        const auto [first, last] = cells_of_body(mesh_, body);
        const bool rigid = bodies_->is_rigid(body);
        for (std::int32_t c = first; c < last; ++c) {
            if (rigid ? !is_own_body[body] : !is_own[c]) continue;
            const std::int32_t in_body =
                rigid ? c - first
                      : static_cast<std::int32_t>(part_->cell_numbers()[bodies_->deformable_cell(c).first]) -
                            part_->body_begin()[deformable];
            own.number.push_back(begin + in_body);
            own.position.push_back(c);
        }
        begin += rigid ? last - first : part_->body_begin()[deformable + 1] - part_->body_begin()[deformable];
        if (!rigid) ++deformable;
    }
    return own;
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::vertex_displacement(std::span<const double> q) const {
    dynamics::refuse_ranks(ranks(), {{"displacements of vertices"}});
    const std::vector<Vector<Dim>> of_cells = cell_displacement(q);
    std::vector<Vector<Dim>> displacement(mesh_.vertices.size(), Vector<Dim>::Zero());
    std::vector<int> n_cells(mesh_.vertices.size(), 0);
    for (std::int32_t c = 0; c < mesh_.n_cells(); ++c) {
        const Matrix<Dim> gradient = displacement_gradient(c, q);
        for (const std::int32_t v : mesh_.cell_vertices[c]) {
            displacement[v] += of_cells[c] + gradient * (mesh_.vertices[v] - mesh_.cell_centroid[c]);
            ++n_cells[v];
        }
    }
    for (std::size_t v = 0; v < displacement.size(); ++v) displacement[v] /= std::max(1, n_cells[v]);
    return displacement;
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::cell_velocity(std::span<const double> p) const {
    std::vector<Vector<Dim>> kept;
    return bodies_->velocities(part_->filled(as_vectors<Dim>(p), kept));
}

template <int Dim>
std::vector<double> Solid<Dim>::displacement_of_points(std::span<const Vector<Dim>> of_cells) const {
    return as_numbers<Dim>(part_->own(bodies_->of_points(of_cells)));
}

template <int Dim>
std::vector<double> Solid<Dim>::momentum_of_points(std::span<const Vector<Dim>> cell_velocity) const {
    return as_numbers<Dim>(part_->own(bodies_->momenta(cell_velocity)));
}

template <int Dim>
std::span<const BondPlace<Dim>> Solid<Dim>::bond_places() const {
    return bonds_->places();
}

template <int Dim>
bool Solid<Dim>::is_broken(std::size_t bond_place) const {
    return bonds_->is_broken(bond_place);
}

template <int Dim>
double Solid<Dim>::bond_share(std::size_t bond_place) const {
    return bonds_->share(bond_place);
}

template <int Dim>
double Solid<Dim>::broken_share() const {
    double all = 0.0, broken = 0.0;
    for (std::size_t i = 0; i < bonds_->places().size(); ++i) {
        const double area = bonds_->places()[i].area;
        all += area;
        if (bonds_->is_broken(i)) broken += area;
    }
    return all > 0.0 ? broken / all : 0.0;
}

template <int Dim>
Matrix<Dim> Solid<Dim>::stress(std::int32_t cell) const {
    const auto [deformable, body] = bodies_->deformable_cell(cell);
    if (deformable < 0) return Matrix<Dim>::Zero();
    const Matrix<Dim>& turn = frames_->end()[static_cast<std::size_t>(body)].turn;
    return turn * ccg_.stress(deformable) * turn.transpose();
}

template <int Dim>
dynamics::MomentArms Solid<Dim>::moment_arms() const {
    return frames_->any_turns() || bodies_->any_rigid() || bodies_->any_finite() ? dynamics::MomentArms::mid_step
                                                                                 : dynamics::MomentArms::rest;
}

template <int Dim>
double Solid<Dim>::step_margin() const {
    if (bodies_->any_finite()) return finite_margin;
    return contact_ ? contact_margin : 1.0;
}

template <int Dim>
double Solid<Dim>::damping_ratio(double omega) const {
    return ranks().largest(ccg_.damping_ratio(omega));
}

#define ABUT_INSTANTIATE(Dim)                                                                                         \
    template double Solid<Dim>::damping_ratio(double) const;                                                          \
    template void Solid<Dim>::evaluate_contact(std::span<const double> q);                                            \
    template ContactField Solid<Dim>::contact_field(std::span<const double> q);                                       \
    template std::vector<TouchingPair<Dim>> Solid<Dim>::touching_pairs(std::span<const double> q, double gap);        \
    template std::vector<ActingPair<Dim>> Solid<Dim>::acting_pairs(std::span<const double> q);                        \
    template std::vector<dynamics::ContactPatch<Dim>> Solid<Dim>::contact_patches() const;                            \
    template double Solid<Dim>::compression() const;                                                                  \
    template Vector<Dim> Solid<Dim>::obstacle_force(std::size_t obstacle) const;                                      \
    template std::span<const BodyImpulse<Dim>> Solid<Dim>::contact_impulses() const;                                  \
    template Matrix<Dim> Solid<Dim>::displacement_gradient(std::int32_t cell, std::span<const double> q) const;       \
    template std::span<const Vector<Dim>> Solid<Dim>::own_points_of(std::size_t, std::span<const Vector<Dim>>) const; \
    template OwnCells Solid<Dim>::own_cells() const;                                                                  \
    template const contact::Contact<Dim>* Solid<Dim>::contact() const;                                                \
    template const contact::NodalContact<Dim>* Solid<Dim>::nodal_contact() const;                                     \
    template double Solid<Dim>::skin() const;                                                                         \
    template contact::ContactReport Solid<Dim>::contact_report() const;                                               \
    template void Solid<Dim>::require_depth() const;                                                                  \
    template dynamics::ContactCounts Solid<Dim>::contact_counts() const;                                              \
    template double Solid<Dim>::out_of_plane_stress(std::int32_t) const;                                              \
    template double Solid<Dim>::plastic_strain(std::int32_t) const;                                                   \
    template std::int32_t Solid<Dim>::cell_of_contact_face(std::int64_t) const;                                       \
    template std::vector<contact::BlindCorner<Dim>> Solid<Dim>::blind_corners() const;                                \
    template std::optional<contact::EdgePair<Dim>> Solid<Dim>::unseen_edges() const;                                  \
    template std::span<const double> Solid<Dim>::inverse_mass() const;                                                \
    template std::span<const double> Solid<Dim>::masses() const;                                                      \
    template std::span<const Vector<Dim>> Solid<Dim>::rest_positions() const;                                         \
    template std::span<const std::int32_t> Solid<Dim>::body_of_points() const;                                        \
    template std::vector<double> Solid<Dim>::rotations(std::span<const double> q) const;                              \
    template std::vector<double> Solid<Dim>::local_rotations(std::span<const double> q);                              \
    template std::vector<Vector<Dim>> Solid<Dim>::cell_displacement(std::span<const double> q) const;                 \
    template std::vector<Vector<Dim>> Solid<Dim>::vertex_displacement(std::span<const double> q) const;               \
    template std::vector<Vector<Dim>> Solid<Dim>::cell_velocity(std::span<const double> p) const;                     \
    template std::vector<double> Solid<Dim>::displacement_of_points(std::span<const Vector<Dim>> of_cells) const;     \
    template std::vector<double> Solid<Dim>::momentum_of_points(std::span<const Vector<Dim>> cell_velocity) const;    \
    template Matrix<Dim> Solid<Dim>::stress(std::int32_t cell) const;                                                 \
    template std::span<const BondPlace<Dim>> Solid<Dim>::bond_places() const;                                         \
    template bool Solid<Dim>::is_broken(std::size_t) const;                                                           \
    template double Solid<Dim>::bond_share(std::size_t) const;                                                        \
    template double Solid<Dim>::broken_share() const;                                                                 \
    template double Solid<Dim>::step_margin() const;                                                                  \
    template dynamics::MomentArms Solid<Dim>::moment_arms() const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
