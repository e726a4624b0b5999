#include "abut/solid/contact/reconstruction_driver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/contact/surface/blind_corners.hpp"
#include "abut/contact/surface/sharp_edges.hpp"
#include "abut/solid/contact/contact_patches.hpp"
#include "abut/solid/contact/solid_friction.hpp"

namespace abut::solid {
namespace {

/// Bodies and obstacles have the numbers of the mesh.
template <int Dim>
contact::ContactOptions contact_options(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                        const Bonds<Dim>& bonds) {
    contact::ContactOptions contact = *options.contact;
    std::vector<std::array<std::int32_t, 2>> bonded;
    for (const BondPlace<Dim>& place : bonds.places()) bonded.push_back(place.bodies);
    sort_unique(bonded);
    contact.search.ignored_bodies = options.ignored_pairs;
    contact.search.ignored_bodies.insert(contact.search.ignored_bodies.end(), bonded.begin(), bonded.end());
    // Faces that the mesh was allowed to have.
    contact.search.planarity_tolerance = std::max(contact.search.planarity_tolerance, 1.001 * mesh.report.worst_planarity);
    return contact;
}

}  // namespace

template <int Dim>
ReconstructionDriver<Dim>::ReconstructionDriver(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, Ccg<Dim>& ccg,
                                                const Loads<Dim>& loads, SolidTimes& times, const RankPart<Dim>& part,
                                                Bonds<Dim>& bonds)
    : mesh_(mesh),
      options_(contact_options(mesh, options, bonds)),
      ccg_(ccg),
      loads_(loads),
      times_(times),
      obstacles_(options.obstacles),
      faces_(shared_faces(part, mesh, ccg)),
      watch_(ccg, part.ranks()),
      bonds_(bonds) {
    build_surface(options);
    options_.friction = friction_between(options, mesh.n_bodies(), surface_.body, [&](std::size_t group) {
        return faces_in_group(mesh, group, *faces_, boundary_of_surface_, surface_.body.size());
    });
    make_contact();
}

template <int Dim>
void ReconstructionDriver<Dim>::build_surface(const SolidOptions<Dim>& options) {
    for (std::size_t i = 0; i < faces_->size(); ++i) {
        const auto face = faces_->rest(i);
        surface_.append(face.corners, face.depth, face.stiffness, face.body);
    }
    boundary_of_surface_.assign(faces_->here().begin(), faces_->here().end());
    if (options.has_friction())
        for (std::int32_t face = 0; face < surface_.size(); ++face)
            surface_.shear_stiffness.push_back(
                options.materials[static_cast<std::size_t>(surface_.body[face])].shear_ratio() * surface_.stiffness[face]);
    obstacles_.append_to(surface_, mesh_.n_bodies());
    surface_.steps_to_sharp_edge = contact::steps_to_sharp_edge(surface_.view());
}

// The path of the listed faces ---------------------------------------------------------------------------------------

template <int Dim>
void ReconstructionDriver<Dim>::follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                                       double cell_motion, double time, double dt) {
    if (!is_surely_valid(cell_motion, time + dt) && !is_valid_at(q_1, time + dt))
        search(q_0, q_1, time, dt);
    else if (!has_stepped_)
        set_start(q_0, time);
    set_end(q_1, time + dt);
}

template <int Dim>
void ReconstructionDriver<Dim>::follow_jump(std::span<const Vector<Dim>> q, double time) {
    if (!is_valid_at(q, time)) search(q, q, time, 0.0);
}

/// By what no cell exceeds in the step: nothing is computed but a sum. Where it says no, `is_valid_at` decides.
template <int Dim>
bool ReconstructionDriver<Dim>::is_surely_valid(double cell_motion, double time) {
    const std::optional<double> motion = watch_.add_step(cell_motion);
    return motion && contact_->is_valid_for(obstacles_.motion(watch_.time(), time) + *motion);
}

template <int Dim>
bool ReconstructionDriver<Dim>::is_valid_at(std::span<const Vector<Dim>> q, double time) {
    const Stopwatch watch(times_.search);
    const double motion = watch_.measure(q, loads_.end());
    return contact_->is_valid_for(obstacles_.motion(watch_.time(), time) + motion);
}

template <int Dim>
void ReconstructionDriver<Dim>::search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time,
                                       double dt) {
    const Stopwatch watch(times_.search);
    const auto u_0 = surface_displacement(q_0, loads_.start(), time);
    const auto u_1 = surface_displacement(q_1, loads_.end(), time + dt);
    contact_->search(u_0, u_1, [&](std::span<const contact::Face> faces) { return list_faces(faces); });
    watch_.set_searched(q_0, loads_.start(), time, q_1, loads_.end());
    set_start(q_0, time);
}

template <int Dim>
contact::FaceCoupling<Dim> ReconstructionDriver<Dim>::list_faces(std::span<const contact::Face> faces) {
    boundary_of_listed_.clear();
    listed_here_.clear();
    n_listed_deformable_ = static_cast<std::size_t>(
        std::ranges::partition_point(faces, [&](contact::Face face) { return !is_of_obstacle(face); }) - faces.begin());
    for (std::size_t i = 0; i < n_listed_deformable_; ++i)
        if (const BoundaryFace b = mesh_boundary(faces[i]); b != no_face) {
            boundary_of_listed_.push_back(b);
            listed_here_.push_back(i);
        }
    faces_->set_listed(faces.first(n_listed_deformable_));
    region_ = ccg_.region_of_faces(faces_->own_listed());
    contact::FaceCoupling<Dim> coupling = faces_->coupling_of_all(ccg_.coupling(boundary_of_listed_));
    coupling.offsets.resize(faces.size() + 1, coupling.offsets.back());
    couple_to_bonds();
    return coupling;
}

template <int Dim>
void ReconstructionDriver<Dim>::couple_to_bonds() {
    bond_answers_.clear();
    const auto bonded = bonds_.bonded_faces();
    if (bonded.empty() || boundary_of_listed_.empty()) return;
    std::vector<BoundaryFace> all(boundary_of_listed_);
    all.insert(all.end(), bonded.begin(), bonded.end());
    sort_unique(all);
    const contact::FaceCoupling<Dim> coupling = ccg_.coupling(all);
    for (std::size_t i = 0; i < boundary_of_listed_.size(); ++i) {
        const auto row = static_cast<std::size_t>(std::ranges::lower_bound(all, boundary_of_listed_[i]) - all.begin());
        for (auto k = static_cast<std::size_t>(coupling.offsets[row]);
             k < static_cast<std::size_t>(coupling.offsets[row + 1]); ++k) {
            const auto at = std::ranges::lower_bound(bonded, all[static_cast<std::size_t>(coupling.columns[k])]);
            if (at != bonded.end() && *at == all[static_cast<std::size_t>(coupling.columns[k])])
                bond_answers_.push_back(
                    {listed_here_[i], static_cast<std::size_t>(at - bonded.begin()), coupling.blocks[k]});
        }
    }
}

/// Bonded faces stand elsewhere, linearly along a step; where listed ones are without contact does not depend on that.
template <int Dim>
void ReconstructionDriver<Dim>::answer_to_bonds(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load,
                                                std::span<Vector<Dim>> gradient) {
    if (bond_answers_.empty()) return;
    const auto displacement = bonds_.displacement_at(q, load);
    for (const auto& [listed, of_bonded, block] : bond_answers_) gradient[listed] += block * displacement[of_bonded];
}

/// Displacement of all faces of the surface.
template <int Dim>
std::vector<Vector<Dim>> ReconstructionDriver<Dim>::surface_displacement(std::span<const Vector<Dim>> q,
                                                                         const BoundaryLoad<Dim>& load, double time) {
    IdVector<BoundaryFace, Vector<Dim>> boundary(static_cast<std::size_t>(ccg_.n_boundary()));
    ccg_.boundary_displacement(q, load, boundary.values());
    std::vector<Vector<Dim>> displacement(static_cast<std::size_t>(surface_.size()));
    faces_->bring_displacement(boundary.values(), displacement);
    obstacles_.displace(time, std::span(displacement).subspan(boundary_of_surface_.size()));
    return displacement;
}

template <int Dim>
void ReconstructionDriver<Dim>::set_start(std::span<const Vector<Dim>> q_0, double time) {
    evaluate_faces(q_0, loads_.start(), time, u_0_, y_0_);
}

template <int Dim>
void ReconstructionDriver<Dim>::set_end(std::span<const Vector<Dim>> q_1, double time) {
    const Stopwatch watch(times_.contact);
    touching_.clear();
    evaluate_faces(q_1, loads_.end(), time, u_1_, y_1_);
}

template <int Dim>
void ReconstructionDriver<Dim>::evaluate_faces(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load, double time,
                                               std::vector<Vector<Dim>>& displacement, std::vector<Vector<Dim>>& gradient) {
    const auto faces = contact_->faces();
    displacement.resize(faces.size());
    gradient.resize(faces.size());
    faces_->evaluate_listed(ccg_, region_, q, load, displacement, gradient);
    answer_to_bonds(q, load, gradient);
    for (std::size_t i = n_listed_deformable_; i < faces.size(); ++i) {
        displacement[i] = obstacles_.displacement(obstacle_of(faces[i]), time);
        gradient[i].setZero();
    }
}

template <int Dim>
void ReconstructionDriver<Dim>::end_step() {
    std::swap(u_0_, u_1_);
    std::swap(y_0_, y_1_);
    has_stepped_ = true;
    watch_.end_step();
}

// Contact on that path -----------------------------------------------------------------------------------------------

template <int Dim>
void ReconstructionDriver<Dim>::integrate(double dt) {
    const Stopwatch watch(times_.contact);
    keep_touching_faces(contact_->integrate(dt, {u_0_, u_1_, y_0_, y_1_}));
}

template <int Dim>
void ReconstructionDriver<Dim>::take_start() {
    keep_touching_faces(contact_->evaluate(u_0_, y_0_));
}

template <int Dim>
void ReconstructionDriver<Dim>::take_end(double dt) {
    const Stopwatch watch(times_.contact);
    keep_touching_faces(contact_->integrate(dt, {u_0_, u_1_, y_0_, y_1_}, contact::TakenForce::end));
}

template <int Dim>
bool ReconstructionDriver<Dim>::integrate_part(PartOfStep<Dim>& part, double time, double dt, double& work) {
    if (!is_valid_at(part.end_of(part.surface_cells()), time + dt))
        search(part.start_of(part.all_cells()), part.end_of(part.all_cells()), time, dt);
    else if (!has_stepped_)
        set_start(part.start_of(input_cells()), time);
    set_end(part.end_of(input_cells()), time + dt);
    integrate(dt);
    take_obstacle_forces(1.0, work);
    obstacles_.add_part(dt);
    add_impulses(dt);
    return !touching_.empty();
}

template <int Dim>
void ReconstructionDriver<Dim>::keep_touching_faces(const contact::ContactStep<Dim>& step) {
    touching_.clear();
    const auto points = [&](contact::Face face) {
        return is_rigid(face) ? std::span<const std::int32_t>{} : faces_->cells_of(static_cast<std::size_t>(face));
    };
    for (const contact::PairStep<Dim>& pair : step.pairs) {
        const contact::Face of_body = is_rigid(pair.face_1) ? pair.face_2 : pair.face_1;
        touching_.push_back(
            {points(pair.face_1), points(pair.face_2), faces_->centroid(static_cast<std::size_t>(of_body)), pair.normal});
    }
}

template <int Dim>
void ReconstructionDriver<Dim>::evaluate_last_end(std::span<const Vector<Dim>>) {
    if (!contact_->faces().empty()) contact_->evaluate(u_0_, y_0_);
}

template <int Dim>
void ReconstructionDriver<Dim>::evaluate(std::span<const Vector<Dim>> q, double time) {
    require_valid_at(q, time);
    evaluate_faces(q, loads_.end(), time, u_1_, y_1_);
    if (!contact_->faces().empty()) contact_->evaluate(u_1_, y_1_);
}

/// Contacts have no history before the first step: then the list may be rebuilt. Later a state for which it is not valid is
/// refused, since a list made there would forget which pairs are in contact.
template <int Dim>
void ReconstructionDriver<Dim>::require_valid_at(std::span<const Vector<Dim>> q, double time) {
    if (watch_.is_end_of_search(q)) return;
    const double motion = obstacles_.motion(watch_.time(), time) + watch_.motion_until(q, loads_.end());
    if (contact_->is_valid_for(motion)) return;
    if (has_stepped_ && std::isfinite(motion))
        throw Misuse("solid: faces may be " + number(motion) +
                         " m away from where contacts were last searched, half the skin of " + number(contact_->skin()) +
                         " m is allowed in a state that no step has reached. Step there, make a Solid for every run, or "
                         "raise CandidateOptions::skin.",
                     {.value = motion, .allowed = 0.5 * contact_->skin()});
    if (!has_stepped_) make_contact();
    search(q, q, time, 0.0);
}

// Results ------------------------------------------------------------------------------------------------------------

template <int Dim>
FaceCorrections<Dim> ReconstructionDriver<Dim>::corrections() const {
    const contact::ContactStep<Dim>& step = contact_->last();
    if (!step.is_active()) return {};
    return {boundary_of_listed_, values_here(step.mean_correction.values(), correction_here_),
            values_here(step.mean_gradient.values(), gradient_here_)};
}

/// Values of the listed faces that are here, from values of all of them.
template <int Dim>
std::span<const Vector<Dim>> ReconstructionDriver<Dim>::values_here(std::span<const Vector<Dim>> of_listed,
                                                                    std::vector<Vector<Dim>>& work) const {
    if (listed_here_.size() == n_listed_deformable_) return of_listed.first(n_listed_deformable_);
    work.clear();
    for (const std::size_t i : listed_here_) work.push_back(of_listed[i]);
    return work;
}

template <int Dim>
void ReconstructionDriver<Dim>::take_obstacle_forces(double share, double& work) {
    obstacles_.clear_forces();
    if (touching_.empty()) return;
    const auto faces = contact_->faces();
    const auto gradients = contact_->last().mean_gradient.values();
    for (std::size_t i = n_listed_deformable_; i < faces.size(); ++i) {
        const Vector<Dim> gradient = gradients[i];
        obstacles_.add_force(obstacle_of(faces[i]), -gradient);
        work += share * gradient.dot(u_1_[i] - u_0_[i]);
    }
}

template <int Dim>
void ReconstructionDriver<Dim>::add_impulses(double dt) {
    const auto body = [&](contact::Face face) { return surface_.body[static_cast<std::size_t>(face)]; };
    const contact::ContactStep<Dim>& step = contact_->last();
    for (const contact::PairStep<Dim>& pair : step.pairs) {
        this->impulses_.add(body(pair.face_1), body(pair.face_2), dt * pair.force, dt * pair.normal_force);
        this->impulses_.add_friction(body(pair.face_1), body(pair.face_2), pair, dt);
    }
    if (const double warning = options_.compression_warning; step.report.compression > warning)
        this->impulses_.add_compression(step.pairs, body, warning);
}

template <int Dim>
double ReconstructionDriver<Dim>::compression() const {
    return contact_->last().report.compression;
}

template <int Dim>
ContactField ReconstructionDriver<Dim>::field() const {
    const auto n = static_cast<std::size_t>(ccg_.n_boundary());
    ContactField field{std::vector<double>(n, 0.0), std::vector<double>(n, std::numeric_limits<double>::infinity())};
    const contact::ContactStep<Dim>& step = contact_->last();
    if (step.is_active())
        for (std::size_t i = 0; i < boundary_of_listed_.size(); ++i) {
            const BoundaryFace b = boundary_of_listed_[i];
            field.pressure[number_of(b)] =
                step.mean_normal_force.values()[listed_here_[i]] / mesh_.face_measure[mesh_face(mesh_, b)];
        }
    for (const contact::AdmittedOverlap<Dim>& overlap : contact_->admitted_overlaps(u_1_))
        for (const contact::Face face : {overlap.face_1, overlap.face_2})
            if (const BoundaryFace b = mesh_boundary(face); b != no_face)
                field.gap[number_of(b)] = std::min(field.gap[number_of(b)], overlap.gap);
    if (options_.friction.any())
        add_friction<Dim>(
            step.pairs, step.friction, [&](contact::Face face) { return mesh_boundary(face); }, mesh_, field);
    return field;
}

template <int Dim>
std::vector<TouchingPair<Dim>> ReconstructionDriver<Dim>::touching_pairs(double gap) const {
    std::vector<TouchingPair<Dim>> touching;
    for (const contact::AdmittedOverlap<Dim>& overlap : contact_->admitted_overlaps(u_1_))
        if (overlap.gap <= gap)
            touching.push_back({mesh_boundary(overlap.face_1), mesh_boundary(overlap.face_2), overlap.normal, overlap.gap});
    return touching;
}

template <int Dim>
std::vector<dynamics::ContactPatch<Dim>> ReconstructionDriver<Dim>::patches() const {
    return contact_patches<Dim>(touching_, [&](std::int32_t cell) { return faces_->holds_of(cell); });
}

template <int Dim>
contact::ContactReport ReconstructionDriver<Dim>::report() const {
    return contact_->report();
}

template <int Dim>
std::vector<contact::BlindCorner<Dim>> ReconstructionDriver<Dim>::blind_corners() const {
    return contact::blind_corners(surface_.view(), options_.search.facing_cosine);
}

template <int Dim>
std::optional<contact::EdgePair<Dim>> ReconstructionDriver<Dim>::unseen_edges() const {
    return contact::unseen_edges(surface_.view(), options_.search.facing_cosine);
}

template class ReconstructionDriver<2>;
template class ReconstructionDriver<3>;

}  // namespace abut::solid
