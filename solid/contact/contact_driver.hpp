#pragma once
// Private to the sources of this layer.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "abut/contact/contact.hpp"
#include "abut/contact/nodal_contact.hpp"
#include "abut/contact/surface/blind_corners.hpp"
#include "abut/contact/surface/unseen_edges.hpp"
#include "abut/dynamics/filter.hpp"
#include "abut/solid/body/body_frames.hpp"
#include "abut/solid/ccg/ccg.hpp"
#include "abut/solid/contact/contact_impulses.hpp"
#include "abut/solid/contact/contact_results.hpp"
#include "abut/solid/contact/obstacles.hpp"

namespace abut::solid {

/// Displacements at both ends of a part of a step, in which not all cells are evaluated: those of the cells that are asked
/// for, in arrays of all [m]. Each is valid until the next call.
template <int Dim>
class PartOfStep {
public:
    PartOfStep() = default;
    PartOfStep(const PartOfStep&) = delete;
    PartOfStep& operator=(const PartOfStep&) = delete;
    virtual ~PartOfStep() = default;

    [[nodiscard]] virtual std::span<const Vector<Dim>> start_of(std::span<const std::int32_t> cells) = 0;
    [[nodiscard]] virtual std::span<const Vector<Dim>> end_of(std::span<const std::int32_t> cells) = 0;
    [[nodiscard]] virtual std::span<const std::int32_t> all_cells() const = 0;
    /// Cells that some boundary face depends on, and those of the faces themselves.
    [[nodiscard]] virtual std::span<const std::int32_t> surface_cells() const = 0;
};

/// Leads contact along the steps of a solid, by one of its laws: it gives the surface, searches where the candidate
/// list is no longer valid, and takes what comes back to the boundary faces. All that asks contact for something is
/// here.
///
/// Displacements q are those of all points (n_points) [m]. A step is `follow`; then `integrate`, or `take_start` and
/// `take_end`; then `end_step`. A step of a driver with `makes_parts` may also be `begin_parts`, then of each part
/// `integrate_part` and `end_step`.
template <int Dim>
class ContactDriver {
public:
    ContactDriver() = default;
    ContactDriver(const ContactDriver&) = delete;
    ContactDriver& operator=(const ContactDriver&) = delete;
    virtual ~ContactDriver() = default;

    // One step

    /// From q_0 at `time` to q_1; no cell moves farther in its frame than `cell_motion` [m], infinity: not known.
    virtual void follow(std::span<const Vector<Dim>> q_0, std::span<const Vector<Dim>> q_1, double cell_motion, double time,
                        double dt) = 0;
    /// Tractions jump in q at `time`, from the loads at the start of the step to those at its end; called before `follow`.
    virtual void follow_jump(std::span<const Vector<Dim>> q, double time) = 0;
    virtual void jumped(std::span<const Vector<Dim>> q, double time) = 0;  ///< the loads at both ends are those after it
    /// Energy where the step that is being made ends, in q, with faces as they are now [J]. The results below are of
    /// that state.
    [[nodiscard]] virtual double energy_at_end(std::span<const Vector<Dim>> q) = 0;
    /// The next step begins where this one ends.
    virtual void end_step() = 0;

    /// Memory of pairs, between two steps.
    [[nodiscard]] virtual std::vector<std::byte> state() const = 0;
    /// Goes on from there, in q, where the last step ended at `time`; frames and loads are those of q.
    virtual void restore(std::span<const std::byte> state, std::span<const Vector<Dim>> q, double time) = 0;

    /// Other faces may touch from now on: the next call looks for them.
    virtual void end_list() {}
    /// Goes on where `before`, of the same law, has stopped; to be followed by `state` and `restore`. `old_boundary`:
    /// of each boundary face of the mesh its index in that of `before`, -1: it was not there.
    virtual void take_over(const ContactDriver& before, std::span<const std::int32_t> old_boundary) = 0;

    // Contact on that path, which takes `dt` [s]. Each replaces the results below.

    /// The mean over the step.
    virtual void integrate(double dt) = 0;
    /// At the start of the step.
    virtual void take_start() = 0;
    /// At its end, with the pairs that may touch as they are at its start.
    virtual void take_end(double dt) = 0;
    /// Evaluates the end of the last step, in q.
    virtual void evaluate_last_end(std::span<const Vector<Dim>> q) = 0;
    /// In one state with the loads at the end of the step, `time` being when the last step ended. Throws Misuse for a state
    /// too far from where candidates were searched.
    virtual void evaluate(std::span<const Vector<Dim>> q, double time) = 0;
    /// As `evaluate` where a step has ended and frames have changed since: pairs that its list does not have bear nothing
    /// yet.
    virtual void evaluate_listed(std::span<const Vector<Dim>> q, double time) { evaluate(q, time); }

    // Steps that are not made by all cells at once

    [[nodiscard]] virtual bool makes_parts() const { return false; }
    /// A step of this length begins [s].
    virtual void begin_parts(double) {}
    /// Contact in a part of it, from `time` on and `dt` long [s], looking at no more cells than it needs; its impulses
    /// and the work of obstacles are booked. Whether some pair is active.
    virtual bool integrate_part(PartOfStep<Dim>&, double, double, double&) { return false; }
    /// Cells that the faces of the list depend on, increasing.
    [[nodiscard]] virtual std::span<const std::int32_t> input_cells() const { return {}; }

    // Results

    [[nodiscard]] virtual FaceCorrections<Dim> corrections() const = 0;
    /// On each body; empty where no body turns.
    [[nodiscard]] virtual std::span<const BodyPush<Dim>> pushes() const { return {}; }
    /// On each rigid body, with moments about arms at rest; empty where there is none.
    [[nodiscard]] virtual std::span<const BodyPush<Dim>> rigid_pushes() const { return {}; }
    /// Contact energy in V that is not contained in that of the cells with these corrections [J].
    [[nodiscard]] virtual double energy() const = 0;
    /// Figures of friction in the last step or evaluation.
    [[nodiscard]] virtual const contact::FrictionFigures& friction() const = 0;
    /// Sets the forces on the obstacles, and adds the work of these in the step: `share` of it [J].
    virtual void take_obstacle_forces(double share, double& work) = 0;
    /// Work of the interference that grew in the step [J].
    [[nodiscard]] virtual double interference_work() const { return 0.0; }
    /// Adds what bodies did to each other on the path of the step, or in a part of it this long [s].
    virtual void add_impulses(double dt) = 0;
    [[nodiscard]] std::span<const BodyImpulse<Dim>> impulses() const { return impulses_.pairs(); }
    void restore_impulses(std::vector<BodyImpulse<Dim>> impulses) { impulses_.restore(std::move(impulses)); }
    [[nodiscard]] virtual const Obstacles<Dim>& obstacles() const = 0;
    /// Largest |g|/D [-].
    [[nodiscard]] virtual double compression() const = 0;
    /// Field of the state that was evaluated last.
    [[nodiscard]] virtual ContactField field() const = 0;
    /// Pairs that touch in the state that was evaluated last, or are open by at most `gap` [m].
    [[nodiscard]] virtual std::vector<TouchingPair<Dim>> touching_pairs(double gap) const = 0;
    /// Pairs in the state that was evaluated last, those without force included.
    [[nodiscard]] virtual std::span<const contact::PairStep<Dim>> pairs() const = 0;
    /// Patches of the last step.
    [[nodiscard]] virtual std::vector<dynamics::ContactPatch<Dim>> patches() const = 0;

    /// Boundary face for a face as errors of contact number it; `no_face` of an obstacle, and where there is none of
    /// that number.
    [[nodiscard]] virtual BoundaryFace mesh_boundary(contact::Face face) const = 0;

    /// Contact itself, as its law has it: on faces or on nodes.
    using ByLaw = std::variant<std::reference_wrapper<const contact::Contact<Dim>>,
                               std::reference_wrapper<const contact::NodalContact<Dim>>>;
    [[nodiscard]] virtual ByLaw contact() const = 0;
    [[nodiscard]] virtual contact::ContactReport report() const = 0;
    virtual void clear_report() = 0;
    [[nodiscard]] virtual double skin() const = 0;  ///< of the candidate list [m]
    [[nodiscard]] virtual std::vector<contact::BlindCorner<Dim>> blind_corners() const = 0;
    [[nodiscard]] virtual std::optional<contact::EdgePair<Dim>> unseen_edges() const = 0;

protected:
    ContactImpulses<Dim> impulses_;
};

}  // namespace abut::solid
