#include "abut/solid/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/solid/body_rotation.hpp"
#include "abut/solid/kinematics/body_frames.hpp"
#include "abut/solid/loads.hpp"
#include "abut/solid/local_levels.hpp"
#include "abut/solid/midpoint.hpp"
#include "abut/solid/pair_potential_driver.hpp"
#include "abut/solid/reconstruction_driver.hpp"

namespace abut::solid {
namespace {

inline constexpr double same_time = 1e-6;  // of a step: sums of steps are rounded

template <int Dim>
const SolidOptions<Dim>& checked(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options) {
    const auto n_bodies = static_cast<std::size_t>(mesh.n_bodies());
    if (!options.acceleration.empty() && options.acceleration.size() != n_bodies)
        throw BadInput(
            mesh.name + ": " + std::to_string(options.acceleration.size()) + " accelerations are given for " +
                std::to_string(n_bodies) + " bodies. Give one per body, or none.",
            {.value = static_cast<double>(options.acceleration.size()), .allowed = static_cast<double>(n_bodies)});
    for (std::size_t body = 0; body < options.acceleration.size(); ++body)
        if (!options.acceleration[body].allFinite())
            throw BadInput(mesh.name + ": the acceleration of body " + std::to_string(body) + " ('" + mesh.body_names[body] +
                           "') is not finite. Correct SolidOptions::acceleration.");
    if (!options.obstacles.empty() && !options.contact)
        throw BadInput(mesh.name + ": " + std::to_string(options.obstacles.size()) +
                       " obstacles are given without contact, so nothing would feel them. Give "
                       "SolidOptions::contact, or no obstacles.");
    if (!options.kinematics.empty() && options.kinematics.size() != n_bodies)
        throw BadInput(mesh.name + ": the kinematics of " + std::to_string(options.kinematics.size()) +
                           " bodies are given for " + std::to_string(n_bodies) + ". Give one per body, or none.",
                       {.value = static_cast<double>(options.kinematics.size()), .allowed = static_cast<double>(n_bodies)});
    return options;
}

template <int Dim>
std::vector<bool> turning(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options) {
    std::vector<bool> turning(static_cast<std::size_t>(mesh.n_bodies()), false);
    for (std::size_t body = 0; body < options.kinematics.size(); ++body)
        turning[body] = options.kinematics[body] == Kinematics::floating;
    return turning;
}

template <int Dim>
std::unique_ptr<BodyFrames<Dim>> frames_of(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options,
                                           std::span<const double> masses) {
    std::vector<std::int32_t> begin;
    for (std::int32_t body = 0; body <= mesh.n_bodies(); ++body)
        begin.push_back(static_cast<std::int32_t>(std::ranges::lower_bound(mesh.cell_body, body) - mesh.cell_body.begin()));
    return std::make_unique<BodyFrames<Dim>>(mesh.cell_centroid, masses, std::move(begin), turning(mesh, options),
                                             mesh.body_names);
}

/// A frame that turns has no place for what is given in space.
template <int Dim>
void require_free_bodies(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options, const Ccg<Dim>& ccg) {
    const std::vector<bool> turns = turning(mesh, options);
    const auto refuse = [&](std::int32_t cell, const std::string& what) {
        const auto body = static_cast<std::size_t>(mesh.cell_body[cell]);
        if (turns[body])
            throw BadInput(mesh.name + ": body '" + mesh.body_names[body] + "' turns with a frame of its own and has " +
                           what + ", which only bodies of Kinematics::small can have.");
    };
    for (const BoundaryFace b : ccg.boundary_faces())
        if (!ccg.prescribed()[b].isZero(0.0)) refuse(cell_of(mesh, b), "a prescribed displacement");
    for (const auto& condition : options.boundary.traction)
        for (const std::int32_t face : mesh.group(condition.group).faces)
            refuse(mesh.face_cells[face][0], "a traction ('" + condition.group + "')");
}

template <int Dim>
ContactLaw chosen_law(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options) {
    const std::vector<bool> turns = turning(mesh, options);
    const bool any_turns =
        std::ranges::find(turns, true) != turns.end() || Obstacles<Dim>(std::span(options.obstacles)).turn();
    if (any_turns && options.law == ContactLaw::reconstruction)
        throw BadInput(mesh.name +
                       ": a body or an obstacle turns, and the modified reconstruction knows normals at rest alone. Choose "
                       "ContactLaw::pair_potential or ContactLaw::automatic.");
    if (options.law != ContactLaw::automatic) return options.law;
    return any_turns ? ContactLaw::pair_potential : ContactLaw::reconstruction;
}

}  // namespace

template <int Dim>
Solid<Dim>::Solid(const mesh::Mesh<Dim>& mesh, SolidOptions<Dim> options)
    : mesh_(mesh), options_(checked(mesh, options)), ccg_(mesh, options_.materials, options_.boundary) {
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const double mass = options_.materials[mesh.cell_body[c]].density * mesh.cell_measure[c];
        masses_.of_cells.push_back(mass);
        masses_.inverse.insert(masses_.inverse.end(), Dim, 1.0 / mass);
    }
    rotation_ = std::make_unique<BodyRotation<Dim>>(mesh, masses_.of_cells);
    frames_ = frames_of(mesh, options_, masses_.of_cells);
    require_free_bodies(mesh, options_, ccg_);
    all_cells_.resize(static_cast<std::size_t>(mesh.n_cells()));
    std::iota(all_cells_.begin(), all_cells_.end(), 0);
    loads_ = std::make_unique<Loads<Dim>>(mesh, options_, masses_.of_cells, ccg_);
    if (!options_.contact) return;
    if (chosen_law(mesh, options_) == ContactLaw::pair_potential) {
        contact_ = std::make_unique<PairPotentialDriver<Dim>>(mesh, options_, ccg_, *loads_, *frames_, times_);
    } else {
        auto driver = std::make_unique<ReconstructionDriver<Dim>>(mesh, options_, ccg_, *loads_, times_);
        reconstruction_ = driver.get();
        contact_ = std::move(driver);
    }
}

template <int Dim>
Solid<Dim>::~Solid() = default;

// One state ----------------------------------------------------------------------------------------------------------

/// Displacements in the frames as they are, of some cells at least.
template <int Dim>
std::span<const Vector<Dim>> Solid<Dim>::in_frames(std::span<const Vector<Dim>> q, std::span<const std::int32_t> cells) {
    if (!frames_->any_turns()) return q;
    in_frames_.resize(q.size());
    frames_->displacement(cells, q, frames_->end(), in_frames_);
    return in_frames_;
}

/// Replaces gradients in the frames by forces in space, body forces included.
template <int Dim>
void Solid<Dim>::to_force(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1,
                          std::span<Vector<Dim>> gradient) {
    if (!frames_->any_turns()) return loads_->to_force(gradient);
    frames_->to_force(q_0, q_1, contact_ ? contact_->pushes() : std::span<const BodyPush<Dim>>{}, loads_->body_force(),
                      gradient);
}

template <int Dim>
void Solid<Dim>::force(std::span<const double> q, std::span<double> force) {
    const auto u = as_vectors<Dim>(q);
    const auto gradient = as_vectors<Dim>(force);
    frames_->stand_at(u);
    if (contact_) contact_->evaluate(u, time_);
    ccg_.gradient(in_frames(u, all_cells_), loads_->end(), corrections(), gradient);
    to_force(u, u, gradient);
}

template <int Dim>
double Solid<Dim>::potential(std::span<const double> q) {
    const auto u = as_vectors<Dim>(q);
    frames_->stand_at(u);
    if (contact_) contact_->evaluate(u, time_);
    const double beside = contact_ ? contact_->energy() : 0.0;
    return ccg_.potential(in_frames(u, all_cells_), loads_->end(), corrections()) + beside - loads_->body_work(u);
}

template <int Dim>
void Solid<Dim>::stiffness_product(std::span<const double> q, std::span<double> product) {
    ccg_.gradient(as_vectors<Dim>(q), ccg_.load_free(), {}, as_vectors<Dim>(product));
}

template <int Dim>
void Solid<Dim>::end_force_on(std::span<const std::int32_t> cells, std::span<const double> q, std::span<Vector<Dim>> force) {
    if (!std::ranges::equal(cells, patch_region_.cells)) patch_region_ = ccg_.region_of_cells(cells);
    const auto u = as_vectors<Dim>(q);
    frames_->stand_at_end();
    if (contact_) contact_->evaluate_last_end(u);
    ccg_.evaluate_cells(patch_region_, in_frames(u, patch_region_.input_cells), loads_->end(), corrections(), force);
    for (std::size_t i = 0; i < cells.size(); ++i)
        force[i] = loads_->force_on(cells[i], frames_->point_to_space(cells[i], force[i]));
}

template <int Dim>
FaceCorrections<Dim> Solid<Dim>::corrections() const {
    return contact_ ? contact_->corrections() : FaceCorrections<Dim>{};
}

// One step for all cells ---------------------------------------------------------------------------------------------

template <int Dim>
void Solid<Dim>::mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                            std::span<double> force) {
    require_start(time, dt);
    const auto u_0 = as_vectors<Dim>(q_0);
    const auto u_1 = as_vectors<Dim>(q_1);
    follow_loads(u_0, time, dt);
    const double motion = take_midpoint(u_0, u_1);
    if (contact_) {
        contact_->follow(u_0, u_1, motion, time, dt);
        contact_->integrate();
    }

    const Stopwatch watch(times_.bulk);
    const auto gradient = as_vectors<Dim>(force);
    const auto take_gradient = [&](const BoundaryLoad<Dim>& load) {
        if (frames_->any_turns())
            ccg_.gradient_of_packed(packed_midpoint_, load, corrections(), gradient);
        else
            ccg_.gradient(midpoint_, load, corrections(), gradient);
    };
    if (loads_->vary())
        take_gradient(loads_->mean());
    else
        take_gradient(loads_->end());
    add_work(1.0);
    to_force(u_0, u_1, gradient);
    evaluations_ += mesh_.n_cells();
    end_step(time + dt);
}

template <int Dim>
void Solid<Dim>::end_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                           std::span<double> force) {
    require_start(time, dt);
    const auto u_0 = as_vectors<Dim>(q_0);
    const auto u_1 = as_vectors<Dim>(q_1);
    const auto gradient = as_vectors<Dim>(force);
    follow_loads(u_0, time, dt);
    frames_->follow(u_0, u_1);
    if (contact_) contact_->follow(u_0, u_1, std::numeric_limits<double>::infinity(), time, dt);
    if (!is_autonomous()) {  // the work is shared between the forces at both ends
        frames_->stand_at_start();
        if (contact_) contact_->take_start();
        ccg_.gradient(in_frames(u_0, all_cells_), loads_->start(), corrections(), gradient);
        add_work(0.5);
    }
    frames_->stand_at_end();
    if (contact_) contact_->take_end();
    const Stopwatch watch(times_.bulk);
    ccg_.gradient(in_frames(u_1, all_cells_), loads_->end(), corrections(), gradient);
    add_work(0.5);
    to_force(u_1, u_1, gradient);
    evaluations_ += mesh_.n_cells();
    end_step(time + dt);
}

template <int Dim>
bool Solid<Dim>::is_autonomous() const {
    return !loads_->vary() && !(contact_ && contact_->obstacles().move());
}

template <int Dim>
void Solid<Dim>::require_start(double time, double dt) const {
    if (loads_->is_half_done())
        throw Misuse(
            "solid: the last step ended with an error, and its loads and work are half done: make a Solid for every run.");
    if (!(std::abs(time - time_) <= same_time * dt) && (contact_ || loads_->vary()))
        throw Misuse("solid: a step begins at " + exact_number(time) + " s, but the last one ended at " +
                         exact_number(time_) +
                         " s. Loads, work and contacts go on from step to step: make a Solid for every run.",
                     {.value = time, .allowed = time_});
}

template <int Dim>
void Solid<Dim>::follow_loads(std::span<const Vector<Dim>> q_0, double time, double dt) {
    if (!loads_->vary()) return;
    const std::span<const double> q(q_0.data()->data(), q_0.size() * Dim);
    const auto search_if_needed = [&] {
        if (contact_) contact_->follow_jump(q_0, time);
    };
    const bool tractions_jump = loads_->begin_step(
        time, dt, [&] { return potential(q); }, search_if_needed, work_);
    if (tractions_jump && contact_) contact_->jumped(q_0, time);
}

/// Fills midpoint_ or packed_midpoint_. No cell moves farther in its frame than what is returned [m]; without contact nobody asks, and it is 0.
template <int Dim>
double Solid<Dim>::take_midpoint(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1) {
    const Stopwatch watch(times_.bulk);
    if (frames_->any_turns()) {
        frames_->follow(q_0, q_1);
        packed_midpoint_.resize(lane_width<Dim> * q_0.size());
        return frames_->take_midpoints(q_0, q_1, packed_midpoint_);
    }
    midpoint_.resize(q_0.size());
    if (contact_) return take_midpoints<Dim>(q_0, q_1, midpoint_);
    parallel_each(static_cast<std::ptrdiff_t>(q_0.size()),
                  [&](std::ptrdiff_t c) { midpoint_[c] = 0.5 * (q_0[c] + q_1[c]); });
    return 0.0;
}

/// `share` of the work from outside in the step that the present gradients of the boundary faces would do.
template <int Dim>
void Solid<Dim>::add_work(double share) {
    loads_->add_work(share, work_);
    if (contact_) contact_->take_obstacle_forces(share, work_);
}

/// The next step begins where this one ends.
template <int Dim>
void Solid<Dim>::end_step(double time) {
    time_ = time;
    loads_->end_step();
    frames_->end_step();
    if (contact_) contact_->end_step();
}

// Local steps --------------------------------------------------------------------------------------------------------

template <int Dim>
void Solid<Dim>::set_levels(std::int32_t n_levels, std::span<const std::int32_t> level) {
    if (frames_->any_turns() || (contact_ && !reconstruction_))
        throw BadInput(mesh_.name +
                       ": local steps are for bodies of Kinematics::small under the modified reconstruction: the frame of a "
                       "body couples all of its cells. Take one step for all (memm), or other kinematics and law.");
    levels_ = std::make_unique<LocalLevels<Dim>>(mesh_, ccg_, *loads_, n_levels, level);
}

template <int Dim>
void Solid<Dim>::add_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double time, double dt,
                             std::span<double> impulse) {
    if (level == 0 && reconstruction_) reconstruction_->obstacles().begin_parts(dt);
    {
        const Stopwatch watch(times_.bulk);
        evaluations_ += levels_->add_bulk_impulse(level, flight, dt, as_vectors<Dim>(impulse));
    }
    if (!levels_->is_finest(level)) return;
    require_start(time, dt);
    if (reconstruction_) add_contact_impulse(flight, time, dt, as_vectors<Dim>(impulse));
    end_step(time + dt);
}

template <int Dim>
void Solid<Dim>::add_contact_impulse(const dynamics::FreeFlight& flight, double time, double dt,
                                     std::span<Vector<Dim>> impulse) {
    follow_flight(flight, time, dt);
    reconstruction_->integrate();
    reconstruction_->take_obstacle_forces(1.0, work_);
    reconstruction_->obstacles().add_part(dt);
    if (!reconstruction_->is_active()) return;
    const Stopwatch watch(times_.contact);
    levels_->add_contact_impulse(reconstruction_->input_cells(), corrections(), dt, impulse);
}

/// As ContactDriver::follow, but looks at no more cells than the surface needs.
template <int Dim>
void Solid<Dim>::follow_flight(const dynamics::FreeFlight& flight, double time, double dt) {
    LocalLevels<Dim>& levels = *levels_;
    if (!reconstruction_->is_valid_at(levels.end_of(flight, dt, levels.surface_cells()), time + dt))
        reconstruction_->search(levels.start_of(flight, levels.all_cells()), levels.end_of(flight, dt, levels.all_cells()),
                                time, dt);
    else if (!reconstruction_->has_stepped())
        reconstruction_->set_start(levels.start_of(flight, reconstruction_->input_cells()), time);
    reconstruction_->set_end(levels.end_of(flight, dt, reconstruction_->input_cells()), time + dt);
}

// Contact ------------------------------------------------------------------------------------------------------------

template <int Dim>
ContactField Solid<Dim>::contact_field(std::span<const double> q) {
    if (contact_) {
        contact_->evaluate(as_vectors<Dim>(q), time_);
        return contact_->field();
    }
    const auto n = static_cast<std::size_t>(ccg_.n_boundary());
    return {std::vector<double>(n, 0.0), std::vector<double>(n, std::numeric_limits<double>::infinity())};
}

template <int Dim>
std::vector<TouchingPair<Dim>> Solid<Dim>::touching_pairs(std::span<const double> q, double gap) {
    if (!contact_) return {};
    contact_->evaluate(as_vectors<Dim>(q), time_);
    return contact_->touching_pairs(gap);
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
Vector<Dim> Solid<Dim>::obstacle_force(std::size_t obstacle) const {
    if (obstacle >= options_.obstacles.size())
        throw Misuse("solid: the force on obstacle " + std::to_string(obstacle) + " is asked for, but there are " +
                     std::to_string(options_.obstacles.size()) + " obstacles, counted from 0.");
    return contact_->obstacles().force(obstacle);
}

template <int Dim>
const contact::Contact<Dim>* Solid<Dim>::contact() const {
    return reconstruction_ ? &reconstruction_->contact() : nullptr;
}

template <int Dim>
const contact::NodalContact<Dim>* Solid<Dim>::nodal_contact() const {
    const auto* driver = dynamic_cast<const PairPotentialDriver<Dim>*>(contact_.get());
    return driver ? &driver->contact() : nullptr;
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
    return {.active_pairs = report.active_pairs, .events = report.events};
}

template <int Dim>
std::int64_t Solid<Dim>::contact_faces_left_out() const {
    return contact_ ? contact_->faces_left_out() : 0;
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::blind_corners() const {
    return contact_ ? contact_->blind_corners() : std::vector<Vector<Dim>>{};
}

template <int Dim>
std::vector<double> Solid<Dim>::rotations(std::span<const double> q) const {
    return rotation_->angles(as_vectors<Dim>(q));
}

template <int Dim>
Matrix<Dim> Solid<Dim>::stress(std::int32_t cell) const {
    const Matrix<Dim>& turn = frames_->end()[static_cast<std::size_t>(mesh_.cell_body[cell])].turn;
    return turn * ccg_.stress(cell) * turn.transpose();
}

template <int Dim>
dynamics::MomentArms Solid<Dim>::moment_arms() const {
    return frames_->any_turns() ? dynamics::MomentArms::mid_step : dynamics::MomentArms::rest;
}

template <int Dim>
std::optional<contact::EdgePair<Dim>> Solid<Dim>::unseen_edges() const {
    return contact_ ? contact_->unseen_edges() : std::nullopt;
}

template class Solid<2>;
template class Solid<3>;

}  // namespace abut::solid
