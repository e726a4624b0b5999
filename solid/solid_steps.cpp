// The steps of a solid: all cells with one, or each level of them with its own.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/base/parallel.hpp"
#include "abut/base/processor_stopwatch.hpp"
#include "abut/base/stopwatch.hpp"
#include "abut/solid/body/bodies.hpp"
#include "abut/solid/body/trapezoid_closure.hpp"
#include "abut/solid/bond/bonds.hpp"
#include "abut/solid/bond/fit_to_law.hpp"
#include "abut/solid/contact/contact_driver.hpp"
#include "abut/solid/load/frame_loads.hpp"
#include "abut/solid/load/loads.hpp"
#include "abut/solid/load/outside_loads.hpp"
#include "abut/solid/load/point_loads.hpp"
#include "abut/solid/local_levels.hpp"
#include "abut/solid/operator/largest_motion.hpp"
#include "abut/solid/options/made_features.hpp"
#include "abut/solid/part/rank_part.hpp"
#include "abut/solid/solid.hpp"

namespace abut::solid {
namespace {

inline constexpr double same_time = 1e-6;  // of a step: sums of steps are rounded

/// Cells that fly freely from now on for `dt` [s], until the next part of the step.
template <int Dim>
class FlightPart final : public PartOfStep<Dim> {
public:
    FlightPart(LocalLevels<Dim>& levels, const dynamics::FreeFlight& flight, double dt)
        : levels_(levels), flight_(flight), dt_(dt) {}

    [[nodiscard]] std::span<const Vector<Dim>> start_of(std::span<const std::int32_t> cells) override {
        return levels_.start_of(flight_, cells);
    }
    [[nodiscard]] std::span<const Vector<Dim>> end_of(std::span<const std::int32_t> cells) override {
        return levels_.end_of(flight_, dt_, cells);
    }
    [[nodiscard]] std::span<const std::int32_t> all_cells() const override { return levels_.all_cells(); }
    [[nodiscard]] std::span<const std::int32_t> surface_cells() const override { return levels_.surface_cells(); }

private:
    LocalLevels<Dim>& levels_;
    const dynamics::FreeFlight& flight_;
    double dt_;
};

/// Keeps that half of the changes whose share falls most, none of a single one. Places whose faces are of one cell hold
/// energy together: some of them may open with D < 0, and wait for the next step.
void keep_half_that_falls_most(std::vector<BondChange>& changes) {
    std::ranges::stable_sort(changes, std::ranges::greater{},
                             [](const BondChange& change) { return change.start - change.end; });
    changes.resize(changes.size() / 2);
    std::ranges::sort(changes, {}, &BondChange::place);
}

}  // namespace

// One step for all cells ---------------------------------------------------------------------------------------------

template <int Dim>
void Solid<Dim>::mean_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                            std::span<double> force) {
    require_start(time, dt);
    const Step step = step_here(q_0, q_1, time, dt, contact::TakenForce::mean);
    const auto u_0 = step.start, u_1 = step.end;
    follow_loads(step);
    const BoundaryLoad<Dim>& start_load = loads_->vary() ? loads_->start() : loads_->end();
    ccg_.begin_step(of_cells(u_0), start_load, dt);
    bodies_->rigid().follow(u_0, u_1);
    const double motion = follow_frames(of_cells(u_0), of_cells(u_1));
    if (contact_) {
        contact_->follow(u_0, u_1, motion, time, dt);
        contact_->integrate(dt);
    }

    const Stopwatch watch(times_.bulk);
    const auto gradient = result_here(force);
    StepEnds<Dim> ends = step_ends(step, start_load);
    const auto take_gradient = [&](const BoundaryLoad<Dim>& load) {
        const ProcessorStopwatch of_cells(times_.own_cells);
        if (frames_->any())
            ccg_.gradient_of_packed(midpoint_, load, corrections(), gradient, ends);
        else
            ccg_.mean_gradient(ends, load, corrections(), gradient);
        bonds_->add_gradient(gradient);
    };
    const std::vector<BondChange> changes = bonds_that_give_way(step, start_load);
    ends.change = bonds_->change();
    if (loads_->vary())
        take_gradient(loads_->mean());
    else
        take_gradient(loads_->end());
    finish_step(step, gradient, force);
    bonds_->end_changes(changes);
    part_frames(u_1);
}

/// Follows the bonds along the step. What of them opens takes energy together; the rest waits for the next step. Shares are
/// those of the mean force.
template <int Dim>
std::vector<BondChange> Solid<Dim>::bonds_that_give_way(const Step& step, const BoundaryLoad<Dim>& start_load) {
    bonds_->follow(step.start, start_load, step.end, loads_->end());
    std::vector<BondChange> by_traction = bonds_->changes();
    if (by_traction.empty()) return by_traction;
    std::vector<BondChange> changes = by_traction;
    double lost = open(changes, step, start_load);
    while (lost < 0.0) {
        bonds_->set_shares(by_traction, Bonds<Dim>::When::start);
        keep_half_that_falls_most(by_traction);
        changes = by_traction;
        lost = changes.empty() ? 0.0 : open(changes, step, start_load);
    }
    dissipated_.in_bonds += lost;
    bonds_->share_loss(lost, changes);
    bonds_->set_shares(changes, Bonds<Dim>::When::middle);
    static_cast<void>(follow_frames(of_cells(step.start), of_cells(step.end)));
    bonds_->follow(step.start, start_load, step.end, loads_->end());
    return changes;
}

/// Broken places go, and each part of what has come apart or become loose in a step that ended at q takes a frame of its
/// own. Contact takes over what sides of broken places press with. What V loses by that is booked. Other faces that a break
/// has laid free touch nothing until contact looks again.
template <int Dim>
void Solid<Dim>::part_frames(std::span<const Vector<Dim>> q) {
    const bool any_broke = bonds_->any_broke(), hands_over = bonds_->any_broke_pressed();
    const auto energy_in_frames = [&] {
        frames_->stand_at(of_cells(q));
        if (contact_) contact_->evaluate_listed(q, time_);
        return stored_energy(q, loads_->end()) + (contact_ ? contact_->energy() : 0.0) + point_loads_->energy(q);
    };
    double before = hands_over ? energy_in_frames() : 0.0;
    if (any_broke) bonds_->leave_out_broken();
    if (hands_over) bonds_->hand_over(before - energy_in_frames());
    std::vector<std::size_t> loose;
    if (const std::vector<std::size_t> opening = bonds_->opening_bodies(); !opening.empty())
        loose = bonds_->loose_bonds(frames_->own_turns(of_cells(q), opening));
    const bool part = !loose.empty() || (any_broke && bonds_->frame_groups() != frames_->united());
    if (part) {
        if (!hands_over) before = energy_in_frames();
        if (!loose.empty()) bonds_->loosen(loose);
        unite_frames();
        frames_->end_at(of_cells(q));
    }
    if (contact_ && hands_over) contact_->end_list();
    if (hands_over || part) dissipated_.at_splits += before - energy_in_frames();
    if (contact_ && (any_broke || part)) contact_->jumped(q, time_);  // more faces may touch than in its list
}

template <int Dim>
void Solid<Dim>::end_force(std::span<const double> q_0, std::span<const double> q_1, double time, double dt,
                           std::span<double> force) {
    require({Feature::end_forces});
    require_start(time, dt);
    const Step step = step_here(q_0, q_1, time, dt, contact::TakenForce::end);
    const auto u_0 = step.start, u_1 = step.end;
    const auto gradient = result_here(force);
    follow_loads(step);
    bodies_->rigid().follow(u_0, u_1);
    const double motion = follow_frames(of_cells(u_0), of_cells(u_1));
    if (contact_) contact_->follow(u_0, u_1, motion, time, dt);
    if (!is_autonomous()) {  // the work is shared between the forces at both ends
        frames_->stand_at_start();
        if (contact_) contact_->take_start();
        bonds_->stand_at(u_0, loads_->start());
        ccg_.step_gradient(in_frames(u_0, all_cells_), loads_->start(), corrections(), gradient);
        bonds_->add_gradient(gradient);
        add_work(0.5);
    }
    frames_->stand_at_end();
    if (contact_) contact_->take_end(dt);
    const Stopwatch watch(times_.bulk);
    {
        const ProcessorStopwatch of_cells(times_.own_cells);
        bonds_->stand_at(u_1, loads_->end());
        ccg_.step_gradient(in_frames(u_1, all_cells_), loads_->end(), corrections(), gradient);
        bonds_->add_gradient(gradient);
    }
    finish_step(step, gradient, force);
}

/// Energy that V loses as these shares go to the middle one where the step starts, and from there on where it ends [J].
template <int Dim>
double Solid<Dim>::energy_lost_by(std::span<const BondChange> changes, const Step& step,
                                  const BoundaryLoad<Dim>& start_load) {
    using When = typename Bonds<Dim>::When;
    const auto energy_at_start = [&](When when) {
        bonds_->set_shares(changes, when);
        return stored_energy(step.start, start_load);
    };
    const auto energy_at_end = [&](When when) {
        bonds_->set_shares(changes, when);
        const double in_cells = stored_energy(step.end, loads_->end()) - bonds_->energy();
        bonds_->see_end(step.end, loads_->end());  // free faces of finite metal are where the step brings them
        return in_cells + bonds_->energy();
    };
    frames_->stand_at_start();
    const double to_middle = energy_at_start(When::start) - energy_at_start(When::middle);
    frames_->stand_at_end();
    return to_middle + energy_at_end(When::middle) - energy_at_end(When::end);
}

/// Energy that these places lose in the step. Those with a fracture energy open so that it is what their laws take.
template <int Dim>
double Solid<Dim>::open(std::vector<BondChange>& changes, const Step& step, const BoundaryLoad<Dim>& start_load) {
    const double by_law = bonds_->energy_by_law(changes);
    if (by_law == 0.0 || !bonds_->have_law(changes)) return energy_lost_by(changes, step, start_load);
    const std::vector<BondChange> by_traction = changes;
    double lost = 0.0;
    const auto excess = [&](const BondOpening& opening) {
        for (std::size_t i = 0; i < changes.size(); ++i) changes[i] = bonds_->opened(by_traction[i], opening);
        lost = energy_lost_by(changes, step, start_load);
        return (lost - bonds_->energy_by_law(changes)) / by_law;
    };
    std::array<double, 2> slopes = bonds_->rise_of_loss(changes);
    for (double& slope : slopes) slope /= by_law;
    fit_to_law(excess, slopes);
    return lost;
}

/// Books the work of the step, makes the force of its gradient, and ends it. Where only a share of the work is booked
/// the rest belongs to a force before: at the end of a step to that at its start.
template <int Dim>
void Solid<Dim>::finish_step(const Step& step, std::span<Vector<Dim>> gradient, std::span<double> force) {
    const bool is_mean = step.take == contact::TakenForce::mean;
    require_no_collapse();
    add_work(step.share());
    if (contact_) {
        contact_->add_impulses(step.dt);
        work_ += contact_->interference_work();
    }
    to_force(is_mean ? step.start : step.end, step.end, gradient);
    if (closure_ && is_mean) closure_->add(step.start, step.end, gradient);
    if (is_mean) add_drag(step, gradient);
    work_ += frame_loads_->work();
    add_point_loads(step, gradient);
    outside_->add_step(step.start, step.end, [this](std::int32_t body) { return mean_turn(body); });
    take_result(force);
    evaluations_ += part_->n_all_cells();
    book_losses();
    flow_faces(step.end);
    end_step(step.time + step.dt);
}

template <int Dim>
bool Solid<Dim>::is_autonomous() const {
    return !any_memory() && !bonds_->any_breaks() && options_.interference.empty() && !loads_->vary() &&
           !point_loads_->do_work() && !frame_loads_->any() && !(contact_ && contact_->obstacles().move());
}

template <int Dim>
void Solid<Dim>::require_start(double time, double dt) const {
    if (loads_->is_half_done())
        throw Misuse(
            "solid: the last step ended with an error, and its loads and work are half done: make a Solid for every run.");
    if (!(std::abs(time - time_) <= same_time * dt) &&
        (contact_ || loads_->vary() || point_loads_->do_work() || frame_loads_->any()))
        throw Misuse("solid: a step begins at " + exact_number(time) + " s, but the last one ended at " +
                         exact_number(time_) +
                         " s. Loads, work and contacts go on from step to step: make a Solid for every run.",
                     {.value = time, .allowed = time_});
}

template <int Dim>
void Solid<Dim>::follow_loads(const Step& step) {
    if (!loads_->vary()) return;
    using Jump = typename Loads<Dim>::Jump;
    double held_change = 0.0;  // of what V has less for loads from outside
    const auto follow_jump = [&](Jump jump) {
        if (contact_) contact_->follow_jump(step.start, step.time);
        if (!outside_->any()) return;
        held_change =
            jump == Jump::tractions ? outside_->held_change(step.start) : outside_->held_change_of_heat(step.start);
    };
    const auto book = [&](Jump jump, double change) {
        work_ += change;
        if (!outside_->any()) return;
        if (jump == Jump::tractions)
            outside_->add_change(change + held_change);
        else
            outside_->add_heat(change, held_change);
    };
    const bool any_jumps = loads_->begin_step(
        step.time, step.dt, outside_->any(), [&] { return potential_here(step.start); }, follow_jump, book);
    if (!any_jumps) return;
    if (frame_loads_->any()) frame_loads_->take(loads_->end());
    if (contact_) contact_->jumped(step.start, step.time);
}

/// Fills midpoint_ where a body turns. No cell moves farther in its frame than what is returned [m]; without contact nobody
/// asks where none turns, and it is 0.
template <int Dim>
double Solid<Dim>::follow_frames(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1) {
    if (!frames_->any()) {
        if (!contact_) return 0.0;
        const Stopwatch watch(times_.search);
        return ranks().largest(largest_motion<Dim>(q_0, q_1));
    }
    const Stopwatch watch(times_.bulk);
    frames_->follow(q_0, q_1);
    frame_loads_->follow();
    midpoint_.resize(lane_width<Dim> * q_0.size());
    return frames_->take_midpoints(q_0, q_1, midpoint_);
}

/// `share` of the work from outside in the step that the present gradients of the boundary faces would do.
template <int Dim>
void Solid<Dim>::add_work(double share) {
    loads_->add_work(share, work_);
    if (bonds_->any() && loads_->vary()) work_ += share * bonds_->work_of_loads(loads_->start(), loads_->end());
    if (contact_) contact_->take_obstacle_forces(share, work_);
}

template <int Dim>
void Solid<Dim>::book_losses() {
    const auto book = [&](double dynamics::Losses::*of) {
        dissipated_.*of += part_->sum_of_cells([&](std::int32_t c) { return ccg_.step_loss(c).*of; });
    };
    const bool none_flows = part_->is_whole() && !ccg_.may_have_flowed();  // several ranks sum what all of them have
    if (any_inelastic() && !none_flows)
        for (double dynamics::Losses::*of :
             {&dynamics::Losses::in_cells, &dynamics::Losses::in_jumps, &dynamics::Losses::on_faces})
            book(of);
    if (ccg_.any_damped())
        for (double dynamics::Losses::*of :
             {&dynamics::Losses::by_damping, &dynamics::Losses::by_viscosity, &dynamics::Losses::lagged})
            book(of);
}

/// The first look is at all features at once, since it may be made at each step.
template <int Dim>
void Solid<Dim>::require(FeatureSet of_use) const {
    if (first_conflict(features_ | of_use, of_use)) require_together(mesh_, options_, of_use);
}

/// Bodies of Kinematics::finite are where they are, and what is linear is asked for in its frame.
template <int Dim>
StepEnds<Dim> Solid<Dim>::step_ends(const Step& step, const BoundaryLoad<Dim>& start_load) {
    if (!any_memory() || !frames_->any())
        return {of_cells(step.start), of_cells(step.end), &start_load, &loads_->end(), step.dt};
    for (std::vector<Vector<Dim>>& in_frame : ends_in_frames_) in_frame.resize(of_cells(step.start).size());
    frames_->displacement(all_cells_, of_cells(step.start), frames_->start(), ends_in_frames_[0]);
    frames_->displacement(all_cells_, of_cells(step.end), frames_->end(), ends_in_frames_[1]);
    return {ends_in_frames_[0], ends_in_frames_[1], &start_load, &loads_->end(), step.dt};
}

/// Adds the forces of Damping::mass.
template <int Dim>
void Solid<Dim>::add_drag(const Step& step, std::span<Vector<Dim>> force) {
    if (!ccg_.any_damped()) return;
    const auto n_cells = static_cast<std::ptrdiff_t>(bodies_->n_cells());
    parallel_each(n_cells, [&](std::ptrdiff_t c) {
        force[c] += ccg_.drag(static_cast<std::int32_t>(c), bodies_->masses()[c], step.end[c] - step.start[c], step.dt);
    });
}

/// Cells remember the step. Where they have moved faces as they flowed contact and bonds go with these, and what that
/// takes out of them is dissipated.
template <int Dim>
void Solid<Dim>::flow_faces(std::span<const Vector<Dim>> q_1) {
    const bool moves =
        (contact_ || bonds_->any()) && ccg_.flows_linearly() && ranks().largest(ccg_.any_face_moves() ? 1.0 : 0.0) > 0.0;
    const auto energy_on_faces = [&] {
        return bonds_->energy_at_end(q_1, loads_->end()) + (contact_ ? contact_->energy_at_end(q_1) : 0.0);
    };
    const double before = moves ? energy_on_faces() : 0.0;
    ccg_.end_step();
    if (moves) dissipated_.on_faces += before - energy_on_faces();
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
    FeatureSet local{Feature::local_steps};
    local.add(Feature::varying_load, loads_->vary());
    require(local | features_of(ranks()));
    levels_ = std::make_unique<LocalLevels<Dim>>(mesh_, ccg_, *loads_, n_levels, level);
}

template <int Dim>
void Solid<Dim>::add_impulse(std::int32_t level, const dynamics::FreeFlight& flight, double time, double dt,
                             std::span<double> impulse) {
    if (level == 0 && contact_) contact_->begin_parts(dt);
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
    FlightPart<Dim> part(*levels_, flight, dt);
    if (!contact_->integrate_part(part, time, dt, work_)) return;
    const Stopwatch watch(times_.contact);
    levels_->add_contact_impulse(contact_->input_cells(), corrections(), dt, impulse);
}

#define ABUT_INSTANTIATE(Dim)                                                                              \
    template void Solid<Dim>::require(FeatureSet) const;                                                   \
    template void Solid<Dim>::mean_force(std::span<const double>, std::span<const double>, double, double, \
                                         std::span<double>);                                               \
    template void Solid<Dim>::end_force(std::span<const double>, std::span<const double>, double, double,  \
                                        std::span<double>);                                                \
    template void Solid<Dim>::part_frames(std::span<const Vector<Dim>>);                                   \
    template bool Solid<Dim>::is_autonomous() const;                                                       \
    template void Solid<Dim>::set_levels(std::int32_t, std::span<const std::int32_t>);                     \
    template void Solid<Dim>::add_impulse(std::int32_t, const dynamics::FreeFlight&, double, double, std::span<double>);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::solid
