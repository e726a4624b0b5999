#pragma once

namespace abut::solid {

/// Work of tractions from outside (TractionCondition::from_outside) so far [J]. H~ + `held` is the energy of the bodies
/// without these loads; `steps` + `changes` is what they have given to it, and `heat` what temperatures have.
struct OutsideWork {
    /// Sum over steps and faces of |f| t . (how far the face has moved in the step, and at its start where a
    /// temperature changes)
    double steps = 0.0;
    double changes = 0.0;  ///< where a traction changes between two steps, the half-cell behind its face gives way at once
    double held = 0.0;     ///< sum of |f| t . û now: V has so much less. Of bodies that turn 0: they book `steps` as work
    double heat = 0.0;     ///< where temperatures change between two steps, the change of V; a part of Solid::work
};

}  // namespace abut::solid
