#pragma once
#include <cstdint>
#include <vector>

#include "abut/base/strided_points.hpp"
#include "abut/base/vector.hpp"
#include "abut/contact/step.hpp"

namespace abut::contact {

/// Action of contact on one body in a step.
template <int Dim>
struct BodyStep {
    std::int32_t body;
    Vector<Dim> force;        ///< mean over the step [N]
    AxialVector<Dim> moment;  ///< of the forces on its nodes about the origin, at the middle of the step [N m]
    /// Work that the body does by its own motion on what it touches [J]: of a rigid body on a given path, the work from
    /// outside
    double work;
};

/// Interaction of two bodies in a step.
template <int Dim>
struct BodyPairStep {
    std::int32_t body_1;
    std::int32_t body_2;
    std::int64_t active_pairs;
    Vector<Dim> force;    ///< on body 2, mean over the step [N]
    double normal_force;  ///< of all pairs [N], > 0 in compression
};

namespace detail {
/// Throws BadInput where a force ends before the nodes that contact pushes.
void check_force_size(std::int64_t given, std::int32_t needed);
}  // namespace detail

/// Result of contact in one step, as a value. Without an active pair all is zero.
template <int Dim>
struct NodalStep {
    std::vector<std::int32_t> nodes;  ///< of the faces in the candidate list, increasing (n)
    std::vector<Vector<Dim>>
        gradient;  ///< what stands for dW/dx in the step, of each of these (n) [N]; the force is minus that
    /// The active pairs, by face; a face with four corners may appear twice with one partner. `gap_0` and `gap_1` are the
    /// least over the overlap, 0 where it is not pressed in.
    std::vector<PairStep<Dim>> pairs;
    std::vector<BodyStep<Dim>> bodies;          ///< those with a face in the candidate list, increasing
    std::vector<BodyPairStep<Dim>> body_pairs;  ///< the same, by (body_1, body_2), body_1 < body_2
    double energy_0 = 0.0;                      ///< W at the start of the step [J], where interference has grown
    double energy = 0.0;                        ///< W at its end [J]
    double work = 0.0;                          ///< what rigid bodies on their paths did on the rest [J]
    /// By how much W grows with the interference in the step, from outside (NodalOptions::interference); with
    /// `TakenForce::end` the mean of that at its start and at its end [J]
    double interference_work = 0.0;
    std::vector<FaceFriction> friction;  ///< of each facet with friction in the last step, by face
    StepReport report;
    std::int32_t least_force_size = 0;  ///< how many nodes a force must have: up to the last one of a deformable face

    [[nodiscard]] bool is_active() const { return !pairs.empty(); }
    /// Adds the forces of the step to those of a host, one per node [N]. `force` may end before the nodes do: a host that
    /// has appended the nodes of obstacles to its own gets the forces on its own alone, `bodies` has those on the obstacles.
    /// Throws BadInput if it ends before `least_force_size`.
    void add_force_to(PointsSpan<Dim> force) const {
        if (force.size() < least_force_size) detail::check_force_size(force.size(), least_force_size);
        if (!is_active()) return;
        for (std::size_t i = 0; i < nodes.size() && nodes[i] < force.size(); ++i) force.add(nodes[i], -gradient[i]);
    }
};

}  // namespace abut::contact
