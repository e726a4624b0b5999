#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "abut/base/vector.hpp"
#include "abut/dynamics/neutral_restart.hpp"
#include "abut/dynamics/own_clock.hpp"
#include "abut/solid/change.hpp"
#include "abut/solid/outside_faces.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/stepped_run.hpp"

namespace abut::solid {

/// How tractions that change within a step of the solid act in it. docs/loads.md, Times that are dictated.
enum class LoadImpulse {
    /// Their mean over the step: the work of the program outside and that of the solid are the same to round-off. Where
    /// tractions answer to the motion of a step it feeds the alternating mode, which neutral restarts take out.
    as_given,
    /// The mean of the loads at both nodes, each from the impulses of the two steps before it: it feeds no mode. The
    /// works differ by a part of order 2.
    trapezoid,
};

/// A solid under MEMM at times that a program outside dictates, as a fluid does that chooses its own steps:
/// docs/loads.md, Times that are dictated. The solid keeps its constant step, so that H~, the order and the remedies
/// are as in any other run.
///
///     solid::ClockedRun<2> clock(run);                        // of a solid::SteppedRun<2>
///     while (clock.time() < end) {
///         const double d = std::min(gas.stable_step(), clock.time_to_node());
///         const double pressure = gas.step(d, clock.motion("bar.xmin", d));
///         clock.set_traction("bar.xmin", tractions(pressure));
///         clock.advance(d);
///     }
///
/// On several ranks all functions but `time` and `time_to_node` are calls of all of them, with the same times and groups.
/// Arrays by face are of the faces that a rank has (OutsideView), and q is that of its points.
template <int Dim>
class ClockedRun {
public:
    /// The run must outlive the clock, which takes its steps. Tractions are those that are set.
    explicit ClockedRun(SteppedRun<Dim>& run, LoadImpulse impulse = LoadImpulse::as_given);

    [[nodiscard]] double time() const { return clock_.time(); }          ///< [s]
    [[nodiscard]] double time_to_node() const { return clock_.left(); }  ///< of the next step of the solid [s], > 0

    /// Tractions on a group that is loaded from outside, from now on until they are set again (n_faces) [Pa]. Throws
    /// BadInput naming the group, a wrong number of values or one that is not finite.
    void set_traction(const std::string& group, std::span<const Vector<Dim>> traction);
    /// Goes on by d [s], of any length; steps of the solid are taken as its nodes are passed. Throws BadInput, and nothing
    /// has changed, unless d > 0 and finite, and the same on all ranks; as SteppedRun::step.
    void advance(double d);

    /// How far the centroids of a group move in the next d [s], whatever acts (n_faces) [m]: sum of |f| t . this is the
    /// work of the tractions. Throws BadInput for a d beyond the next node, where the motion is not known yet.
    [[nodiscard]] std::vector<Vector<Dim>> motion(const std::string& group, double d);
    /// Positions of the faces of a group now; their velocity is that of the step that goes on, normals are those at the
    /// last node.
    [[nodiscard]] OutsideFaces<Dim> faces(const std::string& group);
    /// Displacements of the points now (n_points * Dim) [m].
    [[nodiscard]] std::vector<double> q() { return clock_.q(); }

    /// All that what follows depends on: the same on all ranks, for any number of them.
    struct State {
        RunState run;
        dynamics::RestartReport restarts;
        double time = 0.0;  ///< [s]
        bool has_begun = false;
        /// Traction, mean, load at the node and mean before, group after group, by face of all ranks.
        std::vector<std::vector<Vector<Dim>>> loads;
    };
    [[nodiscard]] State state() const;
    /// Goes back to a state of this run, for a step that is rejected and taken again: what follows has the same bits. Throws
    /// BadInput for that of another run.
    void restore(const State& state);

private:
    struct Load {
        std::string group;
        std::vector<Vector<Dim>> traction;     // now [Pa]
        std::vector<Vector<Dim>> mean;         // since the last node [Pa]; that of a load that stays is exact
        std::vector<Vector<Dim>> at_node;      // trapezoid: L_k [Pa]
        std::vector<Vector<Dim>> mean_before;  // and the mean of the step before [Pa]
        [[nodiscard]] std::array<std::vector<Vector<Dim>>*, 4> all() { return {&traction, &mean, &at_node, &mean_before}; }
        [[nodiscard]] std::array<const std::vector<Vector<Dim>>*, 4> all() const {
            return {&traction, &mean, &at_node, &mean_before};
        }
    };
    [[nodiscard]] Load& load_on(const std::string& group);
    [[nodiscard]] std::vector<Load> loads_of(const State& state) const;
    void require_same(double d) const;
    void add_piece(double s);
    void set_mean(Load& load);
    /// How far the centroids of a group move in the whole step that goes on (n_faces) [m].
    [[nodiscard]] std::vector<Vector<Dim>> step_motion(const std::string& group);

    SteppedRun<Dim>& run_;
    LoadImpulse impulse_;
    dynamics::OwnClock<Solid<Dim>> clock_;
    std::vector<Load> loads_;
    bool has_begun_ = false;  // trapezoid: the loads of the start are known
};

}  // namespace abut::solid
