#include "abut/solid/contact/pair_potential_driver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

#include "abut/base/disjoint_sets.hpp"
#include "abut/base/error.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/geometry/box.hpp"
#include "abut/geometry/polygon.hpp"
#include "abut/solid/contact/bonds_of_faces.hpp"
#include "abut/solid/contact/near_faces.hpp"
#include "abut/solid/contact/solid_friction.hpp"
#include "abut/solid/contact/solid_interference.hpp"

namespace abut::solid {
namespace {

/// In the order of the bodies that contact has. A rigid body never comes together with itself.
template <int Dim>
std::vector<std::array<std::int32_t, 2>> ignored_pairs(const Bodies<Dim>& bodies) {
    std::vector<std::array<std::int32_t, 2>> pairs = bodies.deformable_options().ignored_pairs;
    const std::int32_t n = bodies.mesh().n_bodies();
    std::vector<std::int32_t> of_contact(static_cast<std::size_t>(n));
    for (std::int32_t body = 0; body < n; ++body) of_contact[static_cast<std::size_t>(bodies.mesh_body(body))] = body;
    for (auto& pair : pairs)
        for (std::int32_t& body : pair)
            if (body < n) body = of_contact[static_cast<std::size_t>(body)];
    if (bodies.deformable_options().contact->search.self_contact)
        for (std::int32_t body = 0; body < n; ++body)
            if (bodies.is_rigid(bodies.mesh_body(body))) pairs.push_back({body, body});
    return pairs;
}

/// Leaves out pairs of faces of which one is bonded to the body of the other, and faces that are bonded all over, as the
/// bonds are when it is asked. Pairs begin with the energy by which sides pressed as their place broke.
template <int Dim>
void leave_out_bonded(const CornerSurface<Dim>& corners, const Bonds<Dim>& bonds, contact::NodalOptions& options) {
    if (!bonds.any()) return;
    const auto of_faces = std::make_shared<const BondsOfFaces<Bonds<Dim>>>(bonds);
    options.covered = [of_faces](contact::Face face) { return of_faces->covers(face); };
    const std::vector<std::int32_t> body_of = corners.bodies_of_faces();
    options.wanted = [of_faces, body_of](contact::Face face_1, contact::Face face_2) {
        const auto body = [&](contact::Face face) { return body_of[static_cast<std::size_t>(face)]; };
        return (!of_faces->joins(face_1, body(face_2)) && !of_faces->joins(face_2, body(face_1))) ||
               of_faces->pressed_energy(face_1, face_2) > 0.0;
    };
    options.energy_at_first = [of_faces, body_of](contact::Face face_1, contact::Face face_2) {
        const auto body = [&](contact::Face face) { return body_of[static_cast<std::size_t>(face)]; };
        return of_faces->energy_at_first({face_1, face_2}, {body(face_1), body(face_2)});
    };
}

/// Pieces of bodies that are bonded, directly or through others, in the order of the bodies and obstacles that contact has.
template <int Dim>
std::vector<std::int32_t> bonded_pieces(const Bodies<Dim>& bodies, const Bonds<Dim>& bonds) {
    if (!bonds.any()) return {};
    const std::int32_t n = bodies.mesh().n_bodies();
    DisjointSets joined(static_cast<std::size_t>(n));
    std::vector<char> is_bonded(static_cast<std::size_t>(n), 0);
    for (const BondPlace<Dim>& place : bonds.places()) {
        joined.join(place.bodies[0], place.bodies[1]);
        for (const std::int32_t body : place.bodies) is_bonded[static_cast<std::size_t>(body)] = 1;
    }
    std::vector<std::int32_t> pieces;
    for (std::int32_t body = 0; body < n; ++body) {
        const std::int32_t in_mesh = bodies.mesh_body(body);
        pieces.push_back(is_bonded[static_cast<std::size_t>(in_mesh)] != 0 ? joined.find(in_mesh) : -1);
    }
    pieces.resize(pieces.size() + bodies.deformable_options().obstacles.size(), -1);
    return pieces;
}

template <int Dim>
contact::NodalOptions nodal_options(const Bodies<Dim>& bodies, const CornerSurface<Dim>& corners, const Bonds<Dim>& bonds) {
    const SolidOptions<Dim>& options = bodies.deformable_options();
    const contact::ContactOptions& contact = *options.contact;
    contact::CandidateOptions search = contact.search;
    search.ignored_bodies = ignored_pairs(bodies);
    const auto faces_of = [&](std::size_t group) { return corners.faces_in_group(group); };
    contact::NodalOptions nodal{
        .search = std::move(search),
        .facing = options.facing,
        .events = contact.events,
        .gauss = options.gauss,
        .compression_warning = contact.compression_warning,
        .compression_limit = contact.compression_limit,
        .friction = friction_between(options, bodies.mesh().n_bodies(), corners.bodies_of_faces(), faces_of),
        .interference = interference_between(options, bodies.mesh().n_bodies(), corners.bodies_of_faces(), faces_of),
        .pieces = bonded_pieces(bodies, bonds)};
    leave_out_bonded(corners, bonds, nodal);
    return nodal;
}

}  // namespace

template <int Dim>
PairPotentialDriver<Dim>::PairPotentialDriver(const Bodies<Dim>& bodies, Ccg<Dim>& ccg, const Loads<Dim>& loads,
                                              const BodyFrames<Dim>& frames, SolidTimes& times, const RankPart<Dim>& part,
                                              const Bonds<Dim>& bonds)
    : bodies_(bodies),
      ccg_(ccg),
      loads_(loads),
      frames_(frames),
      times_(times),
      ranks_(part.ranks()),
      obstacles_(bodies.deformable_options().obstacles),
      corners_(bodies, ccg, frames, obstacles_, part),
      contact_(corners_.for_contact(), nodal_options(bodies, corners_, bonds), corners_.sharing()),
      touches_itself_(bodies.deformable_options().contact->search.self_contact),
      all_(corners_.list_all()),
      x_0_(corners_.rest()),
      x_1_(x_0_),
      x_state_(x_0_),
      near_watch_{.corners = corners_.motion(), .from = {}, .radius = {}, .places = {}},
      far_watch_{near_watch_} {
    for (const double depth : contact_.surface().facets().cell_depth) deepest_ = std::max(deepest_, depth);
}

// The path of the listed faces ---------------------------------------------------------------------------------------

template <int Dim>
void PairPotentialDriver<Dim>::follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion,
                                      double time, double dt) {
    end_time_ = time + dt;
    corners_.place_rigid(q_1);
    keep_end(q_1);
    if (is_valid_until(q_1, cell_motion, time + dt)) {
        const Stopwatch watch(times_.contact);
        corners_.place(listed_, q_1, frames_.end(), loads_.end(), time + dt, x_1_, StepState::end);
        set_placed_motion();
    } else {
        const Stopwatch watch(times_.search);
        if (!is_valid_at_all_nodes(q_1, time + dt)) search(q_0, q_1, cell_motion, time, dt);
    }
    has_stepped_ = false;  // until the step has ended well
}

/// Far faces stay where they were placed last as long as none of them can have come near another body: they are in no pair.
template <int Dim>
void PairPotentialDriver<Dim>::search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion,
                                      double time, double dt) {
    if (may_search_near()) {
        search_placed(near_, q_0, q_1, time, dt);
    } else {
        search_placed(all_, q_0, q_1, time, dt);
        searched_at_ = x_0_;
        placed_.clear();
        if (faces_leave_cells()) return;
        begin_far(q_0, cell_motion, time + dt);
    }
    searched_at_ = x_0_;
    begin_near(q_0, cell_motion, time + dt);
}

template <int Dim>
void PairPotentialDriver<Dim>::search_placed(const Listed& placed, std::span<const Vector<Dim>> q_0,
                                             std::span<const Vector<Dim>> q_1, double time, double dt) {
    corners_.place(placed, q_0, frames_.start(), loads_.start(), time, x_0_);
    corners_.place(placed, q_1, frames_.end(), loads_.end(), time + dt, x_1_, StepState::end);
    contact_.search(x_0_, x_1_);
    listed_ = corners_.list(listed_nodes_ = contact_.last().nodes);
}

template <int Dim>
std::vector<std::int32_t> PairPotentialDriver<Dim>::nodes_of(std::span<const std::int32_t> facets) const {
    std::vector<std::int32_t> nodes;
    for (const std::int32_t facet : facets) {
        const auto corners = contact_.surface().facets().view().vertices_of(facet);
        nodes.insert(nodes.end(), corners.begin(), corners.end());
    }
    sort_unique(nodes);
    return nodes;
}

/// Boxes of some facets along the step that candidates are searched for.
template <int Dim>
std::vector<geometry::Box<Dim>> PairPotentialDriver<Dim>::swept_boxes(std::span<const std::int32_t> facets) const {
    const contact::SurfaceView<Dim> of_all = contact_.surface().facets().view();
    std::vector<geometry::Box<Dim>> boxes(facets.size());
    for (std::size_t i = 0; i < facets.size(); ++i)
        for (const std::int32_t n : of_all.vertices_of(facets[i]))
            boxes[i].extend(geometry::Box<Dim>{x_0_[n].cwiseMin(x_1_[n]), x_0_[n].cwiseMax(x_1_[n])});
    return boxes;
}

template <int Dim>
double PairPotentialDriver<Dim>::energy_at_end(std::span<const Vector<Dim>> q) {
    const Stopwatch watch(times_.contact);
    corners_.place(listed_, q, frames_.end(), loads_.end(), end_time_, x_1_, StepState::end);
    contact_.evaluate_listed(x_1_);
    return energy();
}

template <int Dim>
void PairPotentialDriver<Dim>::end_step() {
    std::swap(x_0_, x_1_);
    has_stepped_ = true;
}

// Contact ------------------------------------------------------------------------------------------------------------

template <int Dim>
void PairPotentialDriver<Dim>::integrate(double dt) {
    const Stopwatch watch(times_.contact);
    contact_.step_listed(dt, x_0_, x_1_, contact::TakenForce::mean);
    collect(x_0_, x_1_);
    keep_touching_faces();
}

template <int Dim>
void PairPotentialDriver<Dim>::take_start() {
    contact_.evaluate_listed(x_0_);
    collect(x_0_, x_0_);
}

template <int Dim>
void PairPotentialDriver<Dim>::take_end(double dt) {
    const Stopwatch watch(times_.contact);
    contact_.step_listed(dt, x_0_, x_1_, contact::TakenForce::end);
    collect(x_1_, x_1_);
    keep_touching_faces();
}

template <int Dim>
void PairPotentialDriver<Dim>::evaluate_last_end(std::span<const Vector<Dim>> q) {
    if (!contact_.is_valid_for(0.0)) return evaluate(q, end_time_);
    contact_.evaluate_listed(x_0_);
    collect(x_0_, x_0_);
}

template <int Dim>
void PairPotentialDriver<Dim>::evaluate(std::span<const Vector<Dim>> q, double time) {
    corners_.place_rigid(q);
    if (is_last_end(q, time)) {
        contact_.evaluate_listed(x_0_);
        return collect(x_0_, x_0_);
    }
    if (is_valid_in(q, time)) {
        corners_.place(listed_, q, frames_.end(), loads_.end(), time, x_state_);
        contact_.evaluate_listed(x_state_);
        return collect(x_state_, x_state_);
    }
    corners_.place(all_, q, frames_.end(), loads_.end(), time, x_state_);
    contact_.evaluate(x_state_);
    if (contact_.last().nodes != listed_nodes_) {
        listed_ = corners_.list(listed_nodes_ = contact_.last().nodes);
        has_stepped_ = false;
    }
    collect(x_state_, x_state_);
}

template <int Dim>
void PairPotentialDriver<Dim>::evaluate_listed(std::span<const Vector<Dim>> q, double time) {
    if (!contact_.is_valid_for(0.0)) return evaluate(q, time);
    corners_.place_rigid(q);
    corners_.place(listed_, q, frames_.end(), loads_.end(), time, x_state_);
    contact_.evaluate_listed(x_state_);
    collect(x_state_, x_state_);
}

template <int Dim>
void PairPotentialDriver<Dim>::collect(const Points& x_0, const Points& x_1) {
    face_gradient_.clear();
    cell_moment_.clear();
    pushes_.assign(frames_.n_bodies(), {});
    rigid_pushes_.assign(bodies_.rigid().size(), {});
    const contact::NodalStep<Dim>& step = contact_.last();
    if (!step.is_active()) return;
    face_gradient_.resize(listed_.here.size(), Vector<Dim>::Zero());
    cell_moment_.resize(listed_.here.size(), Matrix<Dim>::Zero());
    std::size_t at = 0;  // nodes and faces are in the same order
    for (std::size_t i = 0; i < step.nodes.size(); ++i) {
        const std::int32_t node = step.nodes[i];
        const Vector<Dim>&p = step.gradient[i], rest = corners_.rest()[node];
        if (p == Vector<Dim>::Zero()) continue;
        if (corners_.is_of_obstacle(node)) break;
        const std::size_t face = corners_.face_of(node);
        if (!corners_.is_deformable(face)) {
            const std::size_t rigid = corners_.rigid_of(face);
            rigid_pushes_[rigid].add(p, rest - bodies_.rigid().rest_centre(rigid));
            continue;
        }
        const std::size_t body = corners_.body_of(face);
        pushes_[body].add(p, 0.5 * (x_0[node] - frames_.start()[body].centre + x_1[node] - frames_.end()[body].centre));
        while (at < listed_.here.size() && static_cast<std::size_t>(listed_.here[at]) < face) ++at;
        if (at == listed_.here.size() || static_cast<std::size_t>(listed_.here[at]) != face) continue;  // of other ranks
        const Vector<Dim> in_frame = frames_.step(body).force_turn().transpose() * p;
        const BoundaryFace b = listed_.boundary[at];
        face_gradient_[at] += in_frame;
        cell_moment_[at] += corners_.free_part(b, in_frame) * (rest - ccg_.centroid(b)).transpose();
    }
}

template <int Dim>
FaceCorrections<Dim> PairPotentialDriver<Dim>::corrections() const {
    if (face_gradient_.empty()) return {};
    return {listed_.boundary, {}, face_gradient_, cell_moment_};
}

template <int Dim>
void PairPotentialDriver<Dim>::take_obstacle_forces(double share, double& work) {
    obstacles_.clear_forces();
    const contact::NodalStep<Dim>& step = contact_.last();
    if (!step.is_active()) return;
    const auto first = std::ranges::lower_bound(step.nodes, corners_.n_body_nodes());
    for (auto i = static_cast<std::size_t>(first - step.nodes.begin()); i < step.nodes.size(); ++i) {
        const std::int32_t node = step.nodes[i];
        obstacles_.add_force(corners_.obstacle_of(node), -step.gradient[i]);
        work += share * step.gradient[i].dot(x_1_[node] - x_0_[node]);
    }
}

template <int Dim>
void PairPotentialDriver<Dim>::add_impulses(double dt) {
    for (const contact::BodyPairStep<Dim>& pair : contact_.last().body_pairs)
        if (pair.active_pairs > 0)
            this->impulses_.add(bodies_.mesh_body(pair.body_1), bodies_.mesh_body(pair.body_2), dt * pair.force,
                                dt * pair.normal_force);
    const auto mesh_body_of = [&](contact::Face face) {
        return bodies_.mesh_body(static_cast<std::int32_t>(corners_.body_of(static_cast<std::size_t>(face))));
    };
    const contact::NodalStep<Dim>& step = contact_.last();
    if (!step.friction.empty())
        for (const contact::PairStep<Dim>& pair : step.pairs)
            this->impulses_.add_friction(mesh_body_of(pair.face_1), mesh_body_of(pair.face_2), pair, dt);
    const double warning = bodies_.deformable_options().contact->compression_warning;
    if (step.report.compression > warning) this->impulses_.add_compression(step.pairs, mesh_body_of, warning);
}

template <int Dim>
void PairPotentialDriver<Dim>::keep_touching_faces() {
    touching_.clear();
    for (const contact::PairStep<Dim>& pair : contact_.last().pairs) {
        TouchingPoints<Dim> touching{corners_.points_of(pair.face_1), corners_.points_of(pair.face_2), Vector<Dim>::Zero(),
                                     pair.normal};
        const auto hold = [&](contact::Face body, contact::Face obstacle) {
            touching.position = middle_of(body);
            touching.normal = obstacle_normal(obstacle);
        };
        if (touching.points_1.empty()) hold(pair.face_2, pair.face_1);
        if (touching.points_2.empty()) hold(pair.face_1, pair.face_2);
        touching_.push_back(touching);
    }
}

/// Middle of a face of a body: at rest where none turns, else in the middle of the step (dynamics::MomentArms).
template <int Dim>
Vector<Dim> PairPotentialDriver<Dim>::middle_of(contact::Face face) const {
    if (!bodies_.any_turns()) return corners_.rest_centroid(face);
    return 0.5 * (corners_.middle(face, x_0_) + corners_.middle(face, x_1_));
}

/// In the middle of the step. What a tilted face pushes along a wall must not let the filter change the momentum along it.
template <int Dim>
Vector<Dim> PairPotentialDriver<Dim>::obstacle_normal(contact::Face face) const {
    const auto& surface = contact_.surface();
    const auto nodes = surface.facets().view().vertices_of(surface.facet_offsets()[static_cast<std::size_t>(face)]);
    std::array<Vector<Dim>, Dim> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = 0.5 * (x_0_[nodes[i]] + x_1_[nodes[i]]);
    return geometry::face_normal<Dim>(corners);
}

// Results ------------------------------------------------------------------------------------------------------------

template <int Dim>
ContactField PairPotentialDriver<Dim>::field() const {
    const mesh::Mesh<Dim>& mesh = bodies_.mesh();
    const std::size_t n = mesh.boundary_faces.size();
    ContactField field{std::vector<double>(n, 0.0), std::vector<double>(n, std::numeric_limits<double>::infinity())};
    for (const contact::PairStep<Dim>& pair : contact_.last().pairs)
        for (const contact::Face face : {pair.face_1, pair.face_2})
            if (const BoundaryFace b = corners_.mesh_boundary(face); b != no_face) {
                field.pressure[number_of(b)] += pair.normal_force / mesh.face_measure[mesh_face(mesh, b)];
                field.gap[number_of(b)] = std::min(field.gap[number_of(b)], pair.gap_1);
            }
    if (bodies_.deformable_options().has_friction())
        add_friction<Dim>(
            contact_.last().pairs, contact_.last().friction,
            [&](contact::Face face) { return corners_.mesh_boundary(face); }, mesh, field);
    return field;
}

template <int Dim>
std::vector<TouchingPair<Dim>> PairPotentialDriver<Dim>::touching_pairs(double gap) const {
    std::vector<TouchingPair<Dim>> touching;
    for (const contact::PairStep<Dim>& pair : contact_.last().pairs)
        if (pair.gap_1 <= gap)
            touching.push_back(
                {corners_.mesh_boundary(pair.face_1), corners_.mesh_boundary(pair.face_2), pair.normal, pair.gap_1});
    return touching;
}

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> PairPotentialDriver<Dim>::patches() const {
    return contact_patches<Dim>(touching_, [&](std::int32_t point) { return corners_.holds_of(point); });
}

// In the numbering of the mesh; that of contact has rigid bodies behind all others.

template <int Dim>
std::vector<contact::BlindCorner<Dim>> PairPotentialDriver<Dim>::blind_corners() const {
    std::vector<contact::BlindCorner<Dim>> corners = contact_.blind_corners();
    for (contact::BlindCorner<Dim>& corner : corners) corner.body = bodies_.mesh_body(corner.body);
    return corners;
}

template <int Dim>
std::optional<contact::EdgePair<Dim>> PairPotentialDriver<Dim>::unseen_edges() const {
    auto edges = contact_.unseen_edges();
    if (edges)
        for (auto* edge : {&edges->edge_1, &edges->edge_2}) edge->body = bodies_.mesh_body(edge->body);
    return edges;
}

template class PairPotentialDriver<2>;
template class PairPotentialDriver<3>;

}  // namespace abut::solid
