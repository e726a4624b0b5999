#pragma once
// Private to the layer.
#include <algorithm>
#include <cmath>

#include "abut/base/vector.hpp"

namespace abut::contact {

/// Along the tangents of a face: one component in 2D, two in 3D.
template <int N>
using Along = SmallMatrix<N, 1>;

/// Friction state of a face.
template <int N>
struct StickState {
    Along<N> stretch = Along<N>::Zero();    ///< s_e, of the spring by which the face sticks [m]
    Along<N> direction = Along<N>::Zero();  ///< m: the force over its limit when it was last known [-], |m| <= 1
    double stiffness = 0.0;                 ///< K [N/m]; 0: nothing presses on the face
    double slid = 0.0;                      ///< path that it has slid so far [m]
    double last_slip = 0.0;                 ///< that of the last step [m]; 0: it stuck

    [[nodiscard]] double energy() const { return 0.5 * stiffness * stretch.squaredNorm(); }
};

/// One step of a face under friction.
template <int N>
struct FrictionStep {
    Along<N> force = Along<N>::Zero();  ///< T, along the motion [N]: the face feels -T; |T| <= limit
    double dissipated = 0.0;            ///< D [J], >= 0 in a mean step: T . motion = energy after - energy before + D
    double slip = 0.0;                  ///< part of the motion by which the face slides [m]
    [[nodiscard]] bool slides() const { return slip > 0.0; }
};

/// `vector` cut to a length.
template <int N>
[[nodiscard]] Along<N> cut_to(const Along<N>& vector, double length) {
    const double norm = vector.norm();
    return norm > length ? Along<N>(vector * (length / norm)) : vector;
}

/// The mean force along a step in which the face moves by `motion` [m], for MEMM. The limit is that of the step [N];
/// `creep` = dt/(2 relaxation time) [-], 0 without. Stretches are means of start and end, so that a slip which
/// alternates from step to step has no force: a force that followed it at once would feed the alternating mode. A face
/// that slides bears the limit of the step, the mean of both directions, unless that would take less from the motion
/// than its spring gains. docs/friction.md.
template <int N>
[[nodiscard]] FrictionStep<N> take_mean_step(StickState<N>& state, const Along<N>& motion, double limit, double creep) {
    const double k = state.stiffness, largest = limit / k;
    const double energy_0 = state.energy();
    const Along<N> start = cut_to<N>(state.stretch, largest);
    const Along<N> tried = ((1.0 - creep) * start + motion) / (1.0 + creep);
    const Along<N> end = cut_to<N>(tried, largest);
    const Along<N> slip = (1.0 + creep) * (tried - end), crept = creep * (start + end);
    const Along<N> direction = largest > 0.0 ? Along<N>(end / largest) : state.direction;

    FrictionStep<N> step;
    const Along<N> of_stretch = 0.5 * k * (start + end);
    const double cut_off = energy_0 - 0.5 * k * start.squaredNorm();
    step.slip = slip.norm();
    if (!step.slides()) {
        step.force = of_stretch;
        step.dissipated = cut_off + of_stretch.dot(crept);
    } else {
        const Along<N> of_direction = 0.5 * limit * (state.direction + direction);
        const double gained = 0.5 * k * (end.squaredNorm() - start.squaredNorm());
        const double lost = of_direction.dot(motion) + cut_off - gained;
        if (lost >= 0.0) {  // the motion pays for what the spring gains where the limit rises
            step.force = of_direction;
            step.dissipated = lost;
        } else {
            const double stretched = (end - start).norm(), share = stretched / (stretched + step.slip);
            step.force = share * of_stretch + (1.0 - share) * of_direction;
            step.dissipated =
                cut_off + share * of_stretch.dot(slip + crept) + (1.0 - share) * (of_direction.dot(motion) - gained);
        }
    }
    state.stretch = end;
    state.direction = direction;
    state.slid += step.slip;
    return step;
}

/// The force at the end of a step, for schemes that take that. D, with the mean of the forces at both ends, may be
/// below 0 by what the normal force changes.
template <int N>
[[nodiscard]] FrictionStep<N> take_end_step(StickState<N>& state, const Along<N>& motion, double limit, double creep) {
    const double k = state.stiffness, largest = limit / k;
    const Along<N> start = state.stretch;
    const double energy_0 = state.energy();
    const Along<N> tried = ((1.0 - creep) * start + motion) / (1.0 + creep);
    state.stretch = cut_to<N>(tried, largest);
    if (largest > 0.0) state.direction = state.stretch / largest;

    FrictionStep<N> step;
    step.force = k * state.stretch;
    step.slip = (1.0 + creep) * (tried - state.stretch).norm();
    step.dissipated = 0.5 * k * (start + state.stretch).dot(motion) - (state.energy() - energy_0);
    state.slid += step.slip;
    return step;
}

}  // namespace abut::contact
