#include "abut/solid/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/contact/blind_corners.hpp"
#include "abut/solid/midpoint.hpp"

namespace abut::solid {
namespace {

inline constexpr double same_time = 1e-6;  // of a step: sums of steps are rounded

template <int Dim>
const SolidOptions<Dim>& checked(const mesh::Mesh<Dim>& mesh, const SolidOptions<Dim>& options) {
    const auto n_bodies = static_cast<std::size_t>(mesh.n_bodies());
    if (!options.acceleration.empty() && options.acceleration.size() != n_bodies)
        throw BadInput(mesh.name + ": " + std::to_string(options.acceleration.size()) + " accelerations are given for " +
                       std::to_string(n_bodies) + " bodies. Give one a body, or none.");
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

/// Sets the positions of some cells at dt from now.
template <int Dim>
void place(const dynamics::FreeFlight& flight, double dt, std::span<const std::int32_t> cells,
           std::span<Vector<Dim>> position) {
    parallel_each(static_cast<std::ptrdiff_t>(cells.size()), [&](std::ptrdiff_t i) {
        const auto first = static_cast<std::size_t>(cells[i]) * Dim;
        for (int d = 0; d < Dim; ++d) position[cells[i]][d] = flight.at(first + d, dt);
    });
}

template <int Dim>
void average(const BoundaryLoad<Dim>& a, const BoundaryLoad<Dim>& b, BoundaryLoad<Dim>& mean) {
    mean = b;
    for (std::size_t i = 0; i < mean.displacement.size(); ++i)
        mean.displacement[i] = 0.5 * (a.displacement[i] + b.displacement[i]);
}

}  // namespace

template <int Dim>
Solid<Dim>::Solid(const mesh::Mesh<Dim>& mesh, SolidOptions<Dim> options)
    : mesh_(mesh), options_(checked(mesh, options)), ccg_(mesh, options_.materials, options_.boundary) {
    for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
        const double mass = options_.materials[mesh.cell_body[c]].density * mesh.cell_measure[c];
        cell_mass_.push_back(mass);
        inverse_mass_.insert(inverse_mass_.end(), Dim, 1.0 / mass);
    }
    if (!options_.acceleration.empty() || options_.body_load) {
        for (std::int32_t c = 0; c < mesh.n_cells(); ++c) {
            Vector<Dim> force = Vector<Dim>::Zero();
            if (!options_.acceleration.empty()) force += cell_mass_[c] * options_.acceleration[mesh.cell_body[c]];
            if (options_.body_load) force += mesh.cell_measure[c] * options_.body_load(mesh.cell_centroid[c]);
            if (!force.allFinite())
                throw BadInput(mesh.name + ": the force on cell " + std::to_string(mesh.cell_label[c]) +
                               " is not finite. Correct SolidOptions::body_load.");
            body_force_.push_back(force);
        }
    }
    load_ = ccg_.load_at(0.0, 0.0);
    load_start_ = load_;
    if (options_.contact) build_surface();
}

template <int Dim>
void Solid<Dim>::build_surface() {
    const auto& prescribed = ccg_.prescribed();
    for (std::int32_t b = 0; b < ccg_.n_boundary(); ++b) {
        if (!prescribed[b].isZero(0.0)) {
            ++left_out_;
            continue;
        }
        const std::int32_t face = mesh_.boundary_faces[b];
        const std::int32_t cell = mesh_.face_cells[face][0];
        std::vector<Vector<Dim>> corners;
        for (const std::int32_t v : mesh_.face_vertices[face]) corners.push_back(mesh_.vertices[v]);
        const double depth = (mesh_.face_centroid[face] - mesh_.cell_centroid[cell]).dot(mesh_.face_normal[face]);
        surface_.append(corners, depth, ccg_.normal_stiffness(b), mesh_.cell_body[cell]);
        surface_boundary_.push_back(b);
    }
    for (std::size_t i = 0; i < options_.obstacles.size(); ++i)
        append(surface_, options_.obstacles[i], mesh_.n_bodies() + static_cast<std::int32_t>(i));
    obstacle_force_.assign(options_.obstacles.size(), Vector<Dim>::Zero());
    contact_.emplace(surface_.view(), *options_.contact);
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
void Solid<Dim>::to_force(std::span<Vector<Dim>> gradient) const {
    const bool loaded = !body_force_.empty();
    parallel_each(static_cast<std::ptrdiff_t>(gradient.size()), [&](std::ptrdiff_t c) {
        gradient[c] = loaded ? Vector<Dim>(body_force_[c] - gradient[c]) : Vector<Dim>(-gradient[c]);
    });
}

template <int Dim>
FaceCorrections<Dim> Solid<Dim>::corrections() const {
    if (!contact_ || contact_->result().active_pairs().empty()) return {};
    const std::size_t n = local_boundary_.size();
    return {local_boundary_, contact_->result().mean_correction().first(n), contact_->result().mean_force().first(n)};
}

template <int Dim>
void Solid<Dim>::force(std::span<const double> q, std::span<double> force) {
    const auto u = as_vectors<Dim>(q);
    evaluate_contact(u);
    ccg_.gradient(u, load_, corrections(), as_vectors<Dim>(force));
    to_force(as_vectors<Dim>(force));
}

template <int Dim>
double Solid<Dim>::potential(std::span<const double> q) {
    const auto u = as_vectors<Dim>(q);
    evaluate_contact(u);
    double energy = ccg_.potential(u, load_, corrections());
    if (!body_force_.empty())
        energy -= ordered_sum(static_cast<std::ptrdiff_t>(u.size()), 0.0,
                              [&](std::ptrdiff_t c) { return body_force_[c].dot(u[c]); });
    return energy;
}

template <int Dim>
void Solid<Dim>::stiffness_product(std::span<const double> q, std::span<double> product) {
    ccg_.gradient(as_vectors<Dim>(q), ccg_.load_free(), {}, as_vectors<Dim>(product));
}

template <int Dim>
void Solid<Dim>::mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                            std::span<double> force) {
    require_start(time, dt);
    const auto u_0 = as_vectors<Dim>(q_0);
    const auto u_1 = as_vectors<Dim>(q_1);
    follow_loads(u_0, time, dt);
    const double motion = take_midpoint(u_0, u_1);
    if (contact_) {
        follow_faces(u_0, u_1, motion, time, dt);
        integrate_contact();
    }

    const Stopwatch watch(times_.bulk);
    const auto gradient = as_vectors<Dim>(force);
    if (ccg_.load_varies()) {
        BoundaryLoad<Dim> mean;
        average(load_start_, load_, mean);
        ccg_.gradient(midpoint_, mean, corrections(), gradient);
    } else {
        ccg_.gradient(midpoint_, load_, corrections(), gradient);
    }
    add_boundary_work(1.0);
    add_obstacle_work(1.0);
    to_force(gradient);
    evaluations_ += mesh_.n_cells();
    end_step(time + dt);
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

template <int Dim>
void Solid<Dim>::end_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                           std::span<double> force) {
    require_start(time, dt);
    const auto u_0 = as_vectors<Dim>(q_0);
    const auto u_1 = as_vectors<Dim>(q_1);
    const auto gradient = as_vectors<Dim>(force);
    follow_loads(u_0, time, dt);
    if (contact_) follow_faces(u_0, u_1, std::numeric_limits<double>::infinity(), time, dt);
    if (!is_autonomous()) {  // the work is shared between the forces at both ends
        if (contact_) {
            contact_->evaluate(u_0_, y_0_);
            keep_active_pairs();
        }
        ccg_.gradient(u_0, load_start_, corrections(), gradient);
        add_boundary_work(0.5);
        add_obstacle_work(0.5);
    }
    if (contact_) {
        const Stopwatch watch(times_.contact);
        contact_->follow(u_0_, u_1_, y_1_);
        keep_active_pairs();
    }
    const Stopwatch watch(times_.bulk);
    ccg_.gradient(u_1, load_, corrections(), gradient);
    add_boundary_work(0.5);
    add_obstacle_work(0.5);
    to_force(gradient);
    evaluations_ += mesh_.n_cells();
    end_step(time + dt);
}

template <int Dim>
bool Solid<Dim>::is_autonomous() const {
    return !ccg_.load_varies() &&
           std::ranges::none_of(options_.obstacles, [](const auto& obstacle) { return bool(obstacle.path); });
}

template <int Dim>
void Solid<Dim>::require_start(double time, double dt) const {
    if (unfinished_)
        throw Misuse(
            "solid: the last step ended with an error, and its loads and work are half done: make a Solid for every run.");
    if (!(std::abs(time - time_) <= same_time * dt) && (contact_ || ccg_.load_varies()))
        throw Misuse("solid: a step begins at " + exact_number(time) + " s, but the last one ended at " +
                     exact_number(time_) +
                     " s. Loads, work and contacts go on from step to step: make a Solid for every run.");
}

template <int Dim>
void Solid<Dim>::set_levels(std::int32_t n_levels, std::span<const std::int32_t> level) {
    if (ccg_.load_varies())
        throw BadInput(mesh_.name +
                       ": a boundary condition has a history, and local time steps do not follow it. Take one "
                       "step for all cells.");
    const std::int32_t n_cells = mesh_.n_cells();
    for (std::size_t i = 0; i < level.size(); ++i)
        if (level[i] != level[i - i % Dim])
            throw BadInput(mesh_.name + ": the components of cell " + std::to_string(mesh_.cell_label[i / Dim]) +
                           " are on different levels. A cell takes its steps as a whole.");
    std::vector<std::int32_t> evaluated(static_cast<std::size_t>(n_cells), 0);  // level of each cell's force
    for (std::int32_t l = 1; l < n_levels; ++l) {
        std::vector<std::int32_t> as_fine;
        for (std::int32_t c = 0; c < n_cells; ++c)
            if (level[static_cast<std::size_t>(c) * Dim] >= l) as_fine.push_back(c);
        // K is symmetric: what these cells depend on depends on them.
        for (const std::int32_t c : ccg_.region_of_cells(as_fine).loaded_cells) evaluated[c] = l;
    }
    level_regions_.clear();
    for (std::int32_t l = 0; l < n_levels; ++l) {
        std::vector<std::int32_t> cells;
        for (std::int32_t c = 0; c < n_cells; ++c)
            if (evaluated[c] == l) cells.push_back(c);
        level_regions_.push_back(ccg_.region_of_cells(cells));
    }
    for (auto* array : {&start_, &moved_, &gradient_}) array->assign(static_cast<std::size_t>(n_cells), Vector<Dim>::Zero());
    surface_cells_.clear();
    for (std::int32_t b = 0; b < ccg_.n_boundary(); ++b)
        surface_cells_.insert(surface_cells_.end(), ccg_.cells_of(b).begin(), ccg_.cells_of(b).end());
    for (const std::int32_t face : mesh_.boundary_faces) surface_cells_.push_back(mesh_.face_cells[face][0]);
    sort_unique(surface_cells_);
    contact_region_ = ccg_.region_of_cells(region_.loaded_cells);
}

template <int Dim>
void Solid<Dim>::add_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double time, double dt,
                             std::span<double> impulse) {
    if (level == 0) {
        local_step_ = dt;
        mean_obstacle_force_.assign(options_.obstacles.size(), Vector<Dim>::Zero());
    }
    add_bulk_impulse(level, flight, dt, as_vectors<Dim>(impulse));
    if (static_cast<std::size_t>(level) + 1 < level_regions_.size()) return;
    require_start(time, dt);
    if (contact_) add_contact_impulse(flight, time, dt, as_vectors<Dim>(impulse));
    end_step(time + dt);
}

/// Linear: the midpoint is exact.
template <int Dim>
void Solid<Dim>::add_bulk_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double dt,
                                  std::span<Vector<Dim>> impulse) {
    const Stopwatch watch(times_.bulk);
    const Region<Dim>& region = level_regions_[level];
    if (region.cells.empty()) return;
    place<Dim>(flight, 0.5 * dt, region.loaded_cells, moved_);
    ccg_.evaluate_cells(region, moved_, load_, {}, gradient_);
    const bool loaded = !body_force_.empty();
    parallel_each(static_cast<std::ptrdiff_t>(region.cells.size()), [&](std::ptrdiff_t i) {
        const std::int32_t c = region.cells[i];
        if (loaded) impulse[c] += dt * body_force_[c];
        impulse[c] -= dt * gradient_[i];
    });
    evaluations_ += static_cast<std::int64_t>(region.cells.size());
}

/// What the corrections and the pair forces add to the force; it is linear in them.
template <int Dim>
void Solid<Dim>::add_contact_impulse(const dynamics::FreeFlight& flight, double time, double dt,
                                     std::span<Vector<Dim>> impulse) {
    follow_flight(flight, time, dt);
    integrate_contact();
    add_obstacle_work(1.0);
    for (std::size_t i = 0; i < obstacle_force_.size(); ++i)
        mean_obstacle_force_[i] += (dt / local_step_) * obstacle_force_[i];
    if (active_pairs_.empty()) return;
    const Stopwatch watch(times_.contact);
    for (const std::int32_t c : contact_region_.loaded_cells) moved_[c].setZero();
    ccg_.evaluate_cells(contact_region_, moved_, ccg_.load_free(), corrections(), gradient_);
    for (std::size_t i = 0; i < contact_region_.cells.size(); ++i) impulse[contact_region_.cells[i]] -= dt * gradient_[i];
}

/// As `follow_faces`, but looks at no more cells than the surface needs.
template <int Dim>
void Solid<Dim>::follow_flight(const dynamics::FreeFlight& flight, double time, double dt) {
    place<Dim>(flight, dt, surface_cells_, moved_);
    if (!list_reaches(moved_, time + dt)) {
        std::vector<std::int32_t> all(static_cast<std::size_t>(mesh_.n_cells()));
        std::iota(all.begin(), all.end(), 0);
        place<Dim>(flight, 0.0, all, start_);
        place<Dim>(flight, dt, all, moved_);
        search(start_, moved_, time, dt);
    } else if (!has_stepped_) {
        place<Dim>(flight, 0.0, region_.loaded_cells, start_);
        evaluate_faces(start_, load_start_, time, u_0_, y_0_);
    }
    place<Dim>(flight, dt, region_.loaded_cells, moved_);
    move_faces(moved_, time + dt);
}

/// The next step begins where this one ends.
template <int Dim>
void Solid<Dim>::end_step(double time) {
    std::swap(u_0_, u_1_);
    std::swap(y_0_, y_1_);
    time_ = time;
    has_stepped_ = true;
    motion_is_known_ = true;
    unfinished_ = false;
}

/// Tractions are constant within a step: where one changes, the jump of the potential is work from outside.
template <int Dim>
void Solid<Dim>::follow_loads(std::span<const Vector<Dim>> q_0, double time, double dt) {
    if (!ccg_.load_varies()) return;
    BoundaryLoad<Dim> changed = ccg_.load_at(time, time);
    if (changed.traction != load_.traction) {
        const std::span<const double> q(q_0.data()->data(), q_0.size() * Dim);
        const double before = potential(q);
        load_ = std::move(changed);
        if (contact_) evaluate_faces(q_0, load_, time, u_0_, y_0_);
        work_ += potential(q) - before;
    }
    unfinished_ = true;
    load_start_ = load_;
    load_ = ccg_.load_at(time + dt, time);
}

template <int Dim>
void Solid<Dim>::integrate_contact() {
    const Stopwatch watch(times_.contact);
    contact_->integrate({u_0_, u_1_, y_0_, y_1_});
    keep_active_pairs();
}

/// The path of the listed faces, with the list made anew where it no longer reaches. No cell moves farther than `motion`;
/// infinity: not known.
template <int Dim>
void Solid<Dim>::follow_faces(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double motion, double time,
                              double dt) {
    if (!surely_reaches(motion, time + dt) && !list_reaches(q_1, time + dt))
        search(q_0, q_1, time, dt);
    else if (!has_stepped_)
        evaluate_faces(q_0, load_start_, time, u_0_, y_0_);
    move_faces(q_1, time + dt);
}

/// The end of the path.
template <int Dim>
void Solid<Dim>::move_faces(std::span<const Vector<Dim>> q_1, double time) {
    const Stopwatch watch(times_.contact);
    active_pairs_.clear();
    evaluate_faces(q_1, load_, time, u_1_, y_1_);
}

template <int Dim>
void Solid<Dim>::keep_active_pairs() {
    const auto active = contact_->result().active_pairs();
    active_pairs_.assign(active.begin(), active.end());
}

/// Whether the candidate list holds where the present step ends, by what no cell exceeds in it: nothing is computed but the
/// sum of all steps since faces were looked at. Where it says no, `list_reaches` decides; so it does in the first step, and in
/// one that is tried again.
template <int Dim>
bool Solid<Dim>::surely_reaches(double motion, double time) {
    travelled_ += motion;
    return std::exchange(motion_is_known_, false) && !ccg_.load_varies() &&
           contact_->covers(obstacle_motion(time) + known_motion_ + ccg_.motion_amplification() * travelled_);
}

/// Whether the candidate list holds there, too.
template <int Dim>
bool Solid<Dim>::list_reaches(std::span<const Vector<Dim>> q, double time) {
    const Stopwatch watch(times_.search);
    known_motion_ = motion_since_search(q);
    travelled_ = 0.0;
    return contact_->covers(obstacle_motion(time) + known_motion_);
}

/// At most, of any face of a body [m]; infinite before the first search.
template <int Dim>
double Solid<Dim>::motion_since_search(std::span<const Vector<Dim>> q) {
    if (searched_.u.empty()) return std::numeric_limits<double>::infinity();
    return ccg_.motion_bound(searched_.u, searched_.load, q, load_);
}

/// The list for one state. Contacts have no history before the first step: then it may be made anew. Later a state out of
/// its reach is refused, since a list made there would forget which pairs are in contact.
template <int Dim>
void Solid<Dim>::require_list(std::span<const Vector<Dim>> q) {
    if (std::ranges::equal(q, swept_end_)) return;
    const double motion = obstacle_motion(time_) + motion_since_search(q);
    if (contact_->covers(motion)) return;
    if (has_stepped_ && std::isfinite(motion))
        throw Misuse("solid: faces may be " + number(motion) +
                     " m away from where contacts were last searched, half the skin of " + number(contact_->skin()) +
                     " m is allowed in a state that no step has reached. Step there, make a Solid for every run, or "
                     "raise CandidateOptions::skin.");
    if (!has_stepped_) contact_.emplace(surface_.view(), *options_.contact);
    search(q, q, time_, 0.0);
}

template <int Dim>
void Solid<Dim>::search(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double time, double dt) {
    const Stopwatch watch(times_.search);
    std::vector<Vector<Dim>> all(static_cast<std::size_t>(ccg_.n_boundary()));
    const auto surface_displacement = [&](std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load, double at) {
        ccg_.boundary_displacement(q, load, all);
        std::vector<Vector<Dim>> displacement(static_cast<std::size_t>(surface_.size()));
        for (std::size_t i = 0; i < surface_boundary_.size(); ++i) displacement[i] = all[surface_boundary_[i]];
        fill_rigid(displacement, at);
        return displacement;
    };
    const auto u_0 = surface_displacement(q_0, load_start_, time);
    const auto u_1 = surface_displacement(q_1, load_, time + dt);
    contact_->search(u_0, u_1, [&](std::span<const std::int32_t> faces) {
        local_boundary_.clear();
        for (const std::int32_t face : faces)
            if (!surface_.view().is_rigid(face)) local_boundary_.push_back(surface_boundary_[face]);
        region_ = ccg_.region_of_faces(local_boundary_);
        contact::FaceCoupling<Dim> coupling = ccg_.coupling(local_boundary_);
        coupling.offsets.resize(faces.size() + 1, coupling.offsets.back());
        return coupling;
    });
    searched_.u.assign(q_0.begin(), q_0.end());
    searched_.load = load_start_;
    searched_time_ = time;
    known_motion_ = motion_since_search(q_1);
    travelled_ = 0.0;
    swept_end_.assign(q_1.begin(), q_1.end());
    if (!level_regions_.empty()) contact_region_ = ccg_.region_of_cells(region_.loaded_cells);
    evaluate_faces(q_0, load_start_, time, u_0_, y_0_);
}

/// How far an obstacle has moved since the last search [m].
template <int Dim>
double Solid<Dim>::obstacle_motion(double time) const {
    double motion = 0.0;
    for (std::size_t i = 0; i < options_.obstacles.size(); ++i)
        motion = larger(motion, (obstacle_displacement(i, time) - obstacle_displacement(i, searched_time_)).norm());
    return motion;
}

template <int Dim>
Vector<Dim> Solid<Dim>::obstacle_displacement(std::size_t obstacle, double time) const {
    const auto& path = options_.obstacles[obstacle].path;
    if (!path) return Vector<Dim>::Zero();
    const Vector<Dim> displacement = path(time);
    if (!displacement.allFinite())
        throw BadInput("obstacle " + std::to_string(obstacle) + ": its displacement at t = " + number(time) +
                       " s is not finite. Correct RigidObstacle::path.");
    return displacement;
}

/// Sets the displacement of the obstacles' faces, which come last.
template <int Dim>
void Solid<Dim>::fill_rigid(std::vector<Vector<Dim>>& displacement, double time) const {
    std::size_t face = surface_boundary_.size();
    for (std::size_t i = 0; i < options_.obstacles.size(); ++i) {
        const Vector<Dim> moved = obstacle_displacement(i, time);
        for (std::size_t j = 0; j < options_.obstacles[i].faces.size(); ++j) displacement[face++] = moved;
    }
}

template <int Dim>
void Solid<Dim>::evaluate_faces(std::span<const Vector<Dim>> q, const BoundaryLoad<Dim>& load, double time,
                                std::vector<Vector<Dim>>& displacement, std::vector<Vector<Dim>>& force) {
    const auto faces = contact_->faces();
    displacement.resize(faces.size());
    force.resize(faces.size());
    ccg_.evaluate_faces(region_, q, load, displacement, force);
    for (std::size_t i = local_boundary_.size(); i < faces.size(); ++i) {
        displacement[i] = obstacle_displacement(obstacle_of(faces[i]), time);
        force[i].setZero();
    }
}

/// Contact of one state with the present loads.
template <int Dim>
void Solid<Dim>::evaluate_contact(std::span<const Vector<Dim>> q) {
    if (!contact_) return;
    require_list(q);
    if (contact_->faces().empty()) return;
    evaluate_faces(q, load_, time_, u_1_, y_1_);
    contact_->evaluate(u_1_, y_1_);
}

/// `share` of the work in the last step that the present face forces would do.
template <int Dim>
void Solid<Dim>::add_boundary_work(double share) {
    if (!ccg_.load_varies()) return;
    for (std::int32_t b = 0; b < ccg_.n_boundary(); ++b)
        work_ += share * ccg_.boundary_force(b).dot(load_.displacement[b] - load_start_.displacement[b]);
}

template <int Dim>
void Solid<Dim>::add_obstacle_work(double share) {
    if (options_.obstacles.empty()) return;
    std::fill(obstacle_force_.begin(), obstacle_force_.end(), Vector<Dim>::Zero());
    if (active_pairs_.empty()) return;
    const auto faces = contact_->faces();
    for (std::size_t i = local_boundary_.size(); i < faces.size(); ++i) {
        const Vector<Dim> gradient = contact_->result().mean_force()[i];
        obstacle_force_[obstacle_of(faces[i])] -= gradient;
        work_ += share * gradient.dot(u_1_[i] - u_0_[i]);
    }
}

template <int Dim>
Vector<Dim> Solid<Dim>::obstacle_force(std::size_t obstacle) const {
    return level_regions_.empty() ? obstacle_force_.at(obstacle) : mean_obstacle_force_.at(obstacle);
}

template <int Dim>
typename Solid<Dim>::ContactField Solid<Dim>::contact_field(std::span<const double> q) {
    ContactField field{
        std::vector<double>(static_cast<std::size_t>(ccg_.n_boundary()), 0.0),
        std::vector<double>(static_cast<std::size_t>(ccg_.n_boundary()), std::numeric_limits<double>::infinity())};
    if (!contact_) return field;
    evaluate_contact(as_vectors<Dim>(q));
    for (std::size_t i = 0; i < local_boundary_.size(); ++i)
        if (!contact_->result().active_pairs().empty())
            field.pressure[local_boundary_[i]] =
                contact_->result().mean_normal_force()[i] / mesh_.face_measure[mesh_.boundary_faces[local_boundary_[i]]];
    const auto lower_gap = [&](std::int32_t face, double gap) {
        if (face == no_face) return;
        field.gap[face] = std::min(field.gap[face], gap);
    };
    visit_contacts([&](const contact::ContactPair<Dim>& pair, double gap) {
        lower_gap(boundary_place(pair.face_1), gap);
        lower_gap(boundary_place(pair.face_2), gap);
    });
    return field;
}

template <int Dim>
template <class Visit>
void Solid<Dim>::visit_contacts(const Visit& visit) const {
    for (const auto& pair : contact_->pairs().pairs()) {
        const auto at = contact_->pairs().position(contact_->surface(), pair, u_1_[contact_->local(pair.face_1)],
                                                   u_1_[contact_->local(pair.face_2)]);
        if (pair.admitted && contact_->pairs().shared_area(pair, at.shift, options_.contact->area).area > 0.0)
            visit(pair, at.gap);
    }
}

template <int Dim>
std::vector<TouchingPair<Dim>> Solid<Dim>::touching_pairs(std::span<const double> q, double gap) {
    std::vector<TouchingPair<Dim>> touching;
    if (!contact_) return touching;
    evaluate_contact(as_vectors<Dim>(q));
    visit_contacts([&](const contact::ContactPair<Dim>& pair, double open) {
        if (open <= gap)
            touching.push_back({boundary_place(pair.face_1), boundary_place(pair.face_2), pair.frame.normal(), open});
    });
    return touching;
}

template <int Dim>
std::vector<Vector<Dim>> Solid<Dim>::blind_corners() const {
    std::vector<Vector<Dim>> places;
    if (!contact_) return places;
    for (const std::int32_t vertex : contact::blind_corners(surface_.view(), options_.contact->search.facing_cosine))
        places.push_back(surface_.vertices[static_cast<std::size_t>(vertex)]);
    return places;
}

template <int Dim>
std::vector<dynamics::ContactPatch> Solid<Dim>::contact_patches() const {
    std::vector<TouchingFaces> touching;
    for (const std::int32_t p : active_pairs_) {
        const auto& pair = contact_->pairs().pairs()[p];
        touching.push_back({boundary_place(pair.face_1), boundary_place(pair.face_2)});
    }
    return solid::contact_patches(ccg_, touching);
}

template <int Dim>
void Solid<Dim>::end_force_on(std::span<const std::int32_t> cells, std::span<const double> q, std::span<Vector<Dim>> force) {
    if (!std::equal(cells.begin(), cells.end(), patch_region_.cells.begin(), patch_region_.cells.end()))
        patch_region_ = ccg_.region_of_cells(cells);
    if (contact_ && !contact_->faces().empty()) contact_->evaluate(u_0_, y_0_);
    ccg_.evaluate_cells(patch_region_, as_vectors<Dim>(q), load_, corrections(), force);
    for (std::size_t i = 0; i < cells.size(); ++i)
        force[i] = body_force_.empty() ? Vector<Dim>(-force[i]) : Vector<Dim>(body_force_[cells[i]] - force[i]);
}

template class Solid<2>;
template class Solid<3>;

}  // namespace abut::solid
