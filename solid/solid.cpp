#include "abut/solid/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/solid/body_rotation.hpp"
#include "abut/solid/contact_driver.hpp"
#include "abut/solid/loads.hpp"
#include "abut/solid/local_levels.hpp"
#include "abut/solid/midpoint.hpp"

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
    return options;
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
    loads_ = std::make_unique<Loads<Dim>>(mesh, options_, masses_.of_cells, ccg_);
    if (options_.contact) contact_ = std::make_unique<ContactDriver<Dim>>(mesh, options_, ccg_, *loads_, times_);
}

template <int Dim>
Solid<Dim>::~Solid() = default;

// One state ----------------------------------------------------------------------------------------------------------

template <int Dim>
void Solid<Dim>::force(std::span<const double> q, std::span<double> force) {
    const auto u = as_vectors<Dim>(q);
    const auto gradient = as_vectors<Dim>(force);
    if (contact_) contact_->evaluate(u, time_);
    ccg_.gradient(u, loads_->end(), corrections(), gradient);
    loads_->to_force(gradient);
}

template <int Dim>
double Solid<Dim>::potential(std::span<const double> q) {
    const auto u = as_vectors<Dim>(q);
    if (contact_) contact_->evaluate(u, time_);
    return ccg_.potential(u, loads_->end(), corrections()) - loads_->body_work(u);
}

template <int Dim>
void Solid<Dim>::stiffness_product(std::span<const double> q, std::span<double> product) {
    ccg_.gradient(as_vectors<Dim>(q), ccg_.load_free(), {}, as_vectors<Dim>(product));
}

template <int Dim>
void Solid<Dim>::end_force_on(std::span<const std::int32_t> cells, std::span<const double> q, std::span<Vector<Dim>> force) {
    if (!std::ranges::equal(cells, patch_region_.cells)) patch_region_ = ccg_.region_of_cells(cells);
    if (contact_) contact_->evaluate_last_end();
    ccg_.evaluate_cells(patch_region_, as_vectors<Dim>(q), loads_->end(), corrections(), force);
    for (std::size_t i = 0; i < cells.size(); ++i) force[i] = loads_->force_on(cells[i], force[i]);
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
    if (loads_->vary())
        ccg_.gradient(midpoint_, loads_->mean(), corrections(), gradient);
    else
        ccg_.gradient(midpoint_, loads_->end(), corrections(), gradient);
    add_work(1.0);
    loads_->to_force(gradient);
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
    if (contact_) contact_->follow(u_0, u_1, std::numeric_limits<double>::infinity(), time, dt);
    if (!is_autonomous()) {  // the work is shared between the forces at both ends
        if (contact_) contact_->take_start();
        ccg_.gradient(u_0, loads_->start(), corrections(), gradient);
        add_work(0.5);
    }
    if (contact_) contact_->take_end();
    const Stopwatch watch(times_.bulk);
    ccg_.gradient(u_1, loads_->end(), corrections(), gradient);
    add_work(0.5);
    loads_->to_force(gradient);
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
    if (tractions_jump && contact_) contact_->set_start(q_0, time);
}

/// Fills midpoint_. No cell moves farther than what is returned [m]; without contact nobody asks, and it is 0.
template <int Dim>
double Solid<Dim>::take_midpoint(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1) {
    const Stopwatch watch(times_.bulk);
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
    if (contact_) contact_->end_step();
}

// Local steps --------------------------------------------------------------------------------------------------------

template <int Dim>
void Solid<Dim>::set_levels(std::int32_t n_levels, std::span<const std::int32_t> level) {
    levels_ = std::make_unique<LocalLevels<Dim>>(mesh_, ccg_, *loads_, n_levels, level);
}

template <int Dim>
void Solid<Dim>::add_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double time, double dt,
                             std::span<double> impulse) {
    if (level == 0 && contact_) contact_->obstacles().begin_parts(dt);
    {
        const Stopwatch watch(times_.bulk);
        evaluations_ += levels_->add_bulk_impulse(level, flight, dt, as_vectors<Dim>(impulse));
    }
    if (!levels_->is_finest(level)) return;
    require_start(time, dt);
    if (contact_) add_contact_impulse(flight, time, dt, as_vectors<Dim>(impulse));
    end_step(time + dt);
}

template <int Dim>
void Solid<Dim>::add_contact_impulse(const dynamics::FreeFlight& flight, double time, double dt,
                                     std::span<Vector<Dim>> impulse) {
    follow_flight(flight, time, dt);
    contact_->integrate();
    contact_->take_obstacle_forces(1.0, work_);
    contact_->obstacles().add_part(dt);
    if (!contact_->is_active()) return;
    const Stopwatch watch(times_.contact);
    levels_->add_contact_impulse(contact_->input_cells(), corrections(), dt, impulse);
}

/// As ContactDriver::follow, but looks at no more cells than the surface needs.
template <int Dim>
void Solid<Dim>::follow_flight(const dynamics::FreeFlight& flight, double time, double dt) {
    LocalLevels<Dim>& levels = *levels_;
    if (!contact_->is_valid_at(levels.end_of(flight, dt, levels.surface_cells()), time + dt))
        contact_->search(levels.start_of(flight, levels.all_cells()), levels.end_of(flight, dt, levels.all_cells()), time,
                         dt);
    else if (!contact_->has_stepped())
        contact_->set_start(levels.start_of(flight, contact_->input_cells()), time);
    contact_->set_end(levels.end_of(flight, dt, contact_->input_cells()), time + dt);
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
    return contact_ ? &contact_->contact() : nullptr;
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
std::optional<contact::EdgePair<Dim>> Solid<Dim>::unseen_edges() const {
    return contact_ ? contact_->unseen_edges() : std::nullopt;
}

template class Solid<2>;
template class Solid<3>;

}  // namespace abut::solid
