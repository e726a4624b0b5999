#include "abut/solid/solid.hpp"

#include <algorithm>
#include <numeric>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/body_rotation.hpp"
#include "abut/solid/body/thick_parts.hpp"
#include "abut/solid/body/trapezoid_closure.hpp"
#include "abut/solid/body/turning_tractions.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/bond/find_bond_places.hpp"
#include "abut/solid/contact/pair_potential_driver.hpp"
#include "abut/solid/contact/reconstruction_driver.hpp"
#include "abut/solid/kinematics/properties.hpp"
#include "abut/solid/load/frame_loads.hpp"
#include "abut/solid/load/loads.hpp"
#include "abut/solid/load/outside_loads.hpp"
#include "abut/solid/load/point_loads.hpp"
#include "abut/solid/local_levels.hpp"
#include "abut/solid/options/law_options.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/part/body_cells.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "abut/solid/part/rank_rows.hpp"

namespace abut::solid {
namespace {

/// Checks for what is not made for several ranks, and what a part lacks.
template <int Dim>
void check_for_ranks(const dynamics::Ranks& ranks, const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options) {
    if (ranks.is_one()) return;
    const auto n_bodies = std::min<std::int32_t>(mesh.n_bodies(), static_cast<std::int32_t>(options.kinematics.size()));
    for (std::int32_t body = 0; body < n_bodies; ++body)
        if (const auto [first, last] = cells_of_body(mesh, body);
            first == last && !properties_of(options.kinematics[static_cast<std::size_t>(body)]).deforms)
            throw BadInput(mesh.name + ": rigid body " + std::to_string(body) +
                           " has no cells in the part of a rank. Give each rank the whole of it (solid::part_of).");
    require_together(mesh, options, {Feature::ranks});
}

template <int Dim>
std::unique_ptr<Bodies<Dim>> bodies_of(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                       const dynamics::Ranks& ranks) {
    dynamics::agreed(ranks, [&] { check_for_ranks(ranks, mesh, options); });
    std::vector<TractionHold> holds = traction_holds(mesh, options, ranks);
    return dynamics::agreed(ranks, [&] { return std::make_unique<Bodies<Dim>>(mesh, options, std::move(holds)); });
}

template <int Dim>
FeatureSet all_features(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options) {
    FeatureSet all = features_of(options);
    for (std::size_t body = 0; body < mesh.body_names.size(); ++body) all = all | features_of(options, body);
    return all;
}

/// By what contact acts on them, if there is anything that a body could touch.
template <int Dim>
FreeFaces free_faces_of(const Bodies<Dim>& bodies) {
    const SolidOptions<Dim>& options = bodies.options();
    const bool has_partner = bodies.mesh().n_bodies() > 1 || !options.obstacles.empty();
    const bool may_touch = options.contact && (has_partner || options.contact->search.self_contact);
    if (!may_touch) return FreeFaces::stay_alone;
    return acting_law(options.law) == ContactLaw::reconstruction ? FreeFaces::are_moved : FreeFaces::are_pushed;
}

/// The points of cells are placed once ranks can be brought together.
template <int Dim>
std::unique_ptr<RankPart<Dim>> part_of_rank(const dynamics::Ranks& ranks, Bodies<Dim>& bodies) {
    auto part = std::make_unique<RankPart<Dim>>(ranks, bodies.points());
    bodies.place_cell_points(*part);
    part->take_rest(bodies.rest());
    bodies.take_part(*part);
    FoundBonds<Dim> bonds = find_bond_places(bodies, *part);
    bodies.take_bonds(std::move(bonds.places), std::move(bonds.coverage), bonds.joined, bonds.glued);
    if (free_faces_of(bodies) == FreeFaces::are_pushed) bodies.take_thick_cells(thick_cells(bodies, *part));
    return part;
}

}  // namespace

template <int Dim>
Solid<Dim>::Solid(const mesh::Mesh<Dim>& mesh, SolidOptions<Dim> options, const dynamics::Ranks& ranks)
    : mesh_(mesh),
      options_(std::move(options)),
      features_(all_features(mesh, options_)),
      bodies_(bodies_of(mesh, options_, ranks)),
      part_(part_of_rank<Dim>(ranks, *bodies_)),
      ccg_(dynamics::agreed(ranks,
                            [&] {
                                const SolidOptions<Dim>& deformable = bodies_->deformable_options();
                                return Ccg<Dim>(bodies_->deformable(), deformable.materials, deformable.boundary,
                                                deformable.kinematics, CellForm::automatic, deformable.precision,
                                                deformable.device, deformable.finite, free_faces_of(*bodies_));
                            })),
      rotation_(std::make_unique<BodyRotation<Dim>>(part_->rest(), part_->masses(), part_->body_begin(), part_->ranks())),
      frames_(std::make_unique<BodyFrames<Dim>>(bodies_->frames(*part_))),
      point_loads_(std::make_unique<PointLoads<Dim>>(*bodies_, ccg_, *part_)),
      all_cells_(static_cast<std::size_t>(bodies_->n_cells())),
      rigid_force_(bodies_->rigid_forces()),
      rigid_stiffness_(bodies_->rigid_stiffness()) {
    std::iota(all_cells_.begin(), all_cells_.end(), 0);
    check_erosion(mesh_.name, options_.erosion, mesh_.body_names);
    if (any_erosion(options_.erosion)) ccg_.watch_strains();
    bodies_->rigid().constrain_only(part_->own_rigid());
    if (!part_->is_whole()) meet_other_ranks();
    if (const SolidOptions<Dim>& deformable = bodies_->deformable_options(); !deformable.temperature_rise.empty())
        ccg_.set_temperature(bodies_->deformable(), deformable.materials, deformable.temperature_rise);
    loads_ = dynamics::agreed(ranks, [&] {
        return std::make_unique<Loads<Dim>>(bodies_->deformable(), bodies_->deformable_options(), bodies_->masses(), ccg_,
                                            *part_);
    });
    frame_loads_ = std::make_unique<FrameLoads<Dim>>(*bodies_, *frames_, *part_);
    if (frame_loads_->any()) frame_loads_->take(loads_->end());
    outside_ = std::make_unique<OutsideLoads<Dim>>(*bodies_, *part_, ccg_, *loads_, point_loads_->tractions());
    const MeanForce mean_force = options_.finite.mean_force;
    if (bodies_->any_finite() && (mean_force == MeanForce::closed_trapezoid || mean_force == MeanForce::automatic))
        closure_ = std::make_unique<TrapezoidClosure<Dim>>(*bodies_, *part_, ccg_);
    bonds_ = std::make_unique<Bonds<Dim>>(*bodies_, ccg_, *frames_, *part_);
    unite_frames();
    if (!options_.contact) return;
    const ContactLaw law = acting_law(options_.law);
    refuse_choices_of_other_law(law, options_);
    if (law == ContactLaw::pair_potential) {
        contact_ = std::make_unique<PairPotentialDriver<Dim>>(*bodies_, ccg_, *loads_, *frames_, times_, *part_, *bonds_);
    } else {
        contact_ = std::make_unique<ReconstructionDriver<Dim>>(mesh, options_, ccg_, *loads_, times_, *part_, *bonds_);
    }
}

template <int Dim>
Solid<Dim>::~Solid() = default;

/// Bodies have the frames of what bonds hold together.
template <int Dim>
void Solid<Dim>::unite_frames() {
    std::vector<std::int32_t> groups = bonds_->frame_groups();
    if (groups == frames_->united()) return;
    frames_->unite(std::move(groups));
    if (frame_loads_->any()) frame_loads_->take(loads_->end());
}

/// What is brought from them and computed here is what forces on own cells depend on.
template <int Dim>
void Solid<Dim>::meet_other_ranks() {
    check_rows_of_ranks(*part_, bodies_->deformable(), ccg_);
    std::vector<std::int32_t> cells = ccg_.compute_only(part_->own_cells());
    for (const BoundaryFace face : part_->own_faces()) {  // what bonds ask of them: rows have cells of no weight, too
        const auto of_row = ccg_.cells_of(face);
        cells.insert(cells.end(), of_row.begin(), of_row.end());
    }
    sort_unique(cells);
    part_->fill_only(cells);
    ccg_.watch_only(part_->own_faces());
}

template <int Dim>
const dynamics::Ranks& Solid<Dim>::ranks() const {
    return part_->ranks();
}

template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::state_here(std::span<const double> q) {
    return part_->state(as_vectors<Dim>(q));
}

template <int Dim>
auto Solid<Dim>::step_here(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                           contact::TakenForce take) -> Step {
    const auto [start, end] = part_->step(as_vectors<Dim>(q_0), as_vectors<Dim>(q_1));
    return {start, end, time, dt, take};
}

/// Array for what `take_result` makes by point.
template <int Dim>
std::span<Vector<Dim>> Solid<Dim>::result_here(std::span<double> of_points) {
    return part_->result(as_vectors<Dim>(of_points));
}

template <int Dim>
void Solid<Dim>::take_result(std::span<double> of_points) const {
    part_->take_result(as_vectors<Dim>(of_points));
}

/// The part of what is by point that belongs to cells.
template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::of_cells(std::span<const Vector<Dim>> q) const {
    return q.first(static_cast<std::size_t>(bodies_->n_cells()));
}

// One state ----------------------------------------------------------------------------------------------------------

/// Displacements in the frames as they are, of some cells at least.
template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::in_frames(std::span<const Vector<Dim>> q, std::span<const std::int32_t> cells) {
    if (!frames_->any()) return of_cells(q);
    in_frames_.resize(q.size());
    frames_->displacement(cells, q, frames_->end(), in_frames_);
    return in_frames_;
}

/// Replaces gradients in the frames by forces in space, body forces included.
template <int Dim>
void Solid<Dim>::to_force(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                          std::span<Vector<Dim>> gradient) {
    if (bodies_->any_rigid()) rigid_to_force(gradient);
    const auto cells = gradient.first(static_cast<std::size_t>(bodies_->n_cells()));
    if (!frames_->any()) return loads_->to_force(cells);
    const auto pushes =
        frame_loads_->pushes(bonds_->pushes(contact_ ? contact_->pushes() : std::span<const BodyPush<Dim>>{}));
    frames_->to_force(of_cells(q_0), of_cells(q_1), pushes, loads_->body_force(), cells);
}

/// On the points of rigid bodies.
template <int Dim>
void Solid<Dim>::rigid_to_force(std::span<Vector<Dim>> force) const {
    const auto pushes = contact_ ? contact_->rigid_pushes() : std::span<const BodyPush<Dim>>{};
    for (std::size_t i = 0; i < bodies_->rigid().size(); ++i) {
        const BodyPush<Dim> push = pushes.empty() ? BodyPush<Dim>{} : pushes[i];
        bodies_->rigid().set_gradient(i, push.gradient, push.moment, force);
    }
    for (auto i = static_cast<std::size_t>(bodies_->n_cells()); i < force.size(); ++i) force[i] = rigid_force_[i] - force[i];
}

/// With their work.
template <int Dim>
void Solid<Dim>::add_point_loads(const Step& step, std::span<Vector<Dim>> force) {
    if (!point_loads_->any()) return;
    point_loads_->add(
        step.start, step.end, step.time, step.dt, step.take, [this](std::int32_t body) { return mean_turn(body); }, force,
        work_);
}

/// Mean turn of the frame of a body or of a rigid one, between both ends of the step or in the state that is evaluated.
template <int Dim>
Matrix<Dim> Solid<Dim>::mean_turn(std::int32_t body) const {
    return bodies_->mean_turn(body, *frames_);
}

template <int Dim>
void Solid<Dim>::set_rates(std::span<const double> q, std::span<const double> p) {
    if (ccg_.any_damped()) {
        const bool moves = std::ranges::any_of(p, [](double value) { return value != 0.0; });
        if (ranks().largest(moves ? 1.0 : 0.0) == 0.0) ccg_.bring_to_rest();
    }
    if (!point_loads_->damp()) return;
    std::vector<double> v(p.begin(), p.end());
    for (std::size_t i = 0; i < v.size(); ++i) v[i] *= inverse_mass()[i];
    std::vector<Vector<Dim>> kept_q, kept_v;
    const auto q_here = part_->filled(as_vectors<Dim>(q), kept_q);
    point_loads_->set_rates(q_here, part_->filled(as_vectors<Dim>(std::span<const double>(v)), kept_v));
}

/// Frames and contact stand in this state.
template <int Dim>
void Solid<Dim>::stand_at(std::span<const Vector<Dim>> u) {
    frames_->stand_at(of_cells(u));
    if (contact_) contact_->evaluate(u, time_);
}

template <int Dim>
void Solid<Dim>::force(std::span<const double> q, std::span<double> force) {
    const auto u = state_here(q);
    const auto gradient = result_here(force);
    stand_at(u);
    bonds_->stand_at(u, loads_->end());
    ccg_.gradient(in_frames(u, all_cells_), loads_->end(), corrections(), gradient);
    add_other_forces(u, gradient);
    take_result(force);
}

template <int Dim>
double Solid<Dim>::potential_and_force(std::span<const double> q, std::span<double> force) {
    const auto u = state_here(q);
    const auto gradient = result_here(force);
    stand_at(u);
    bonds_->stand_at(u, loads_->end());
    std::vector<double> energies(static_cast<std::size_t>(bodies_->n_cells()));
    ccg_.gradient_and_energies(in_frames(u, all_cells_), loads_->end(), corrections(), gradient, energies);
    const double potential = with_other_energies(u, sum_of_stored(energies, loads_->end()));
    add_other_forces(u, gradient);
    take_result(force);
    return potential;
}

/// Makes the force of the gradient of cells.
template <int Dim>
void Solid<Dim>::add_other_forces(std::span<const Vector<Dim>> u, std::span<Vector<Dim>> gradient) {
    bonds_->add_gradient(gradient);
    to_force(u, u, gradient);
    if (point_loads_->any())
        point_loads_->add_at(
            u, time_, [this](std::int32_t body) { return mean_turn(body); }, gradient);
    bodies_->rigid().add_constraint_forces(u, gradient);
}

template <int Dim>
double Solid<Dim>::potential(std::span<const double> q) {
    return potential_here(state_here(q));
}

template <int Dim>
double Solid<Dim>::potential_here(std::span<const Vector<Dim>> u) {
    stand_at(u);
    return with_other_energies(u, stored_energy(u, loads_->end()));
}

/// V, of what cells and bonds store.
template <int Dim>
double Solid<Dim>::with_other_energies(std::span<const Vector<Dim>> u, double stored) const {
    double energy = stored - loads_->body_work(of_cells(u));
    if (contact_) energy += contact_->energy();
    energy += point_loads_->energy(u);
    for (auto i = static_cast<std::size_t>(bodies_->n_cells()); i < u.size(); ++i) energy -= rigid_force_[i].dot(u[i]);
    return energy;
}

/// In cells and bonds, less the work of tractions, where the frames stand.
template <int Dim>
double Solid<Dim>::stored_energy(std::span<const Vector<Dim>> u, const BoundaryLoad<Dim>& load) {
    bonds_->stand_at(u, load);
    const auto in_frame = in_frames(u, all_cells_);
    return sum_of_stored(ccg_.cell_energies(in_frame, load, corrections()), load);
}

template <int Dim>
double Solid<Dim>::sum_of_stored(std::span<const double> of_cells, const BoundaryLoad<Dim>& load) const {
    const double stored =
        bonds_->energy() + part_->sum_of_cells([&](std::int32_t c) { return of_cells[static_cast<std::size_t>(c)]; });
    const BoundaryConditions<Dim>& conditions = bodies_->deformable_options().boundary;
    if (conditions.dirichlet.empty() && conditions.traction.empty()) return stored;
    return stored - part_->fold_faces(0.0, [&](BoundaryFace face) { return ccg_.traction_work(face, load); });
}

template <int Dim>
void Solid<Dim>::stiffness_product(std::span<const double> q, std::span<double> product) {
    const auto u = state_here(q);
    const auto result = result_here(product);
    stiffness_of_cells(of_cells(u), result);
    for (auto i = static_cast<std::size_t>(bodies_->n_cells()); i < u.size(); ++i) result[i] = rigid_stiffness_[i] * u[i];
    point_loads_->add_stiffness(u, result);
    take_result(product);
}

/// dV/du of some cells; where there are bonds of all, since a bonded face answers to cells of both sides.
template <int Dim>
void Solid<Dim>::evaluate_patch(std::span<const std::int32_t> cells, std::span<const Vector<Dim>> u,
                                std::span<Vector<Dim>> gradient) {
    if (bonds_->any()) {
        std::vector<Vector<Dim>> of_all(static_cast<std::size_t>(bodies_->n_cells()));
        bonds_->stand_at(u, loads_->end());
        ccg_.gradient(in_frames(u, all_cells_), loads_->end(), corrections(), of_all);
        bonds_->add_gradient(of_all);
        for (std::size_t i = 0; i < cells.size(); ++i) gradient[i] = of_all[static_cast<std::size_t>(cells[i])];
        return;
    }
    if (!std::ranges::equal(cells, patch_region_.cells)) patch_region_ = ccg_.region_of_cells(cells);
    ccg_.evaluate_cells(patch_region_, in_frames(u, patch_region_.input_cells), loads_->end(), corrections(), gradient);
}

template <int Dim>
void Solid<Dim>::end_force_on(std::span<const std::int32_t> points, std::span<const double> q,
                              std::span<Vector<Dim>> force) {
    std::vector<std::int32_t> here(points.begin(), points.end());
    const auto positions = ranks().positions();
    for (std::int32_t& point : here) point = positions[static_cast<std::size_t>(point)];
    const std::vector<std::int32_t> cells(here.begin(), std::ranges::lower_bound(here, bodies_->n_cells()));
    const auto u = state_here(q);
    frames_->stand_at_end();
    if (contact_) contact_->evaluate_last_end(u);
    if (!cells.empty() || bonds_->any()) evaluate_patch(cells, u, force);
    for (std::size_t i = 0; i < cells.size(); ++i)
        force[i] = loads_->force_on(cells[i], frames_->point_to_space(cells[i], force[i]));
    if (cells.size() == here.size() && !point_loads_->any()) return;
    std::vector<Vector<Dim>> of_points(u.size(), Vector<Dim>::Zero());
    rigid_to_force(of_points);
    point_loads_->add_at(
        u, time_, [this](std::int32_t body) { return mean_turn(body); }, of_points);
    bodies_->rigid().add_constraint_forces(u, of_points);
    for (std::size_t i = 0; i < cells.size(); ++i) force[i] += of_points[here[i]];
    for (std::size_t i = cells.size(); i < here.size(); ++i) force[i] = of_points[here[i]];
}

template <int Dim>
FaceCorrections<Dim> Solid<Dim>::corrections() {
    return bonds_->corrections(contact_ ? contact_->corrections() : FaceCorrections<Dim>{});
}

// Rigid bodies -------------------------------------------------------------------------------------------------------

template <int Dim>
bool Solid<Dim>::has_constraints() const {
    return bodies_->any_rigid();
}

template <int Dim>
bool Solid<Dim>::is_constrained(std::int32_t point) const {
    return point >= std::ssize(part_->own_cells());
}

/// Calls constrain(q, p) with values by point here; each rank constrains its own bodies.
template <int Dim>
template <class Constrain>
void Solid<Dim>::constrain_own(std::span<const double> q, std::span<double> p, const Constrain& constrain) {
    if (!bodies_->any_rigid()) return;
    part_->constrain_rigid(as_vectors<Dim>(q), as_vectors<Dim>(p), constrain);
}

template <int Dim>
void Solid<Dim>::constrain_along(std::span<const double> q, double dt, std::span<double> p) {
    constrain_own(q, p, [&](auto of_q, auto of_p) { bodies_->rigid().constrain_along(of_q, dt, of_p); });
}

template <int Dim>
void Solid<Dim>::constrain_at(std::span<const double> q, double dt, std::span<double> p) {
    constrain_own(q, p, [&](auto of_q, auto of_p) { bodies_->rigid().constrain_at(of_q, dt, of_p); });
}

template class Solid<2>;
template class Solid<3>;

}  // namespace abut::solid
