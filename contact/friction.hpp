#pragma once
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "abut/contact/surface/surface.hpp"

namespace abut::contact {

/// A face that slides, or may begin to, in a step: what a coefficient of friction may depend on. All of it is known
/// before the force is.
struct Sliding {
    double speed;     ///< of the motion past the faces that press on it, mean over the time in which they do [m/s]
    double slid;      ///< path that it has slid until the start of the step [m]
    double pressure;  ///< mean normal force over the area in contact [Pa]
};

/// A law of friction. Faces that are pressed together stick by the shear of the half cells behind both, and slide where that
/// would take more than
///
///     mu(v, s) N + c A,   mu = mu_sliding + (mu_rest - mu_sliding) exp(-v / decay_speed) max(0, 1 - s / decay_slip).
///
/// N is the normal force, A the area in contact, v the speed and s the path of sliding (Sliding). Coulomb's law has
/// `coefficient` alone, Tresca's `strength` alone. docs/friction.md.
struct Friction {
    double coefficient = 0.0;  ///< mu_rest [-], >= 0
    /// mu_sliding [-], >= 0; NaN: `coefficient`. Without `decay_speed` or `decay_slip` it has no effect
    double sliding_coefficient = std::numeric_limits<double>::quiet_NaN();
    double decay_speed = std::numeric_limits<double>::infinity();  ///< [m/s] > 0
    double decay_slip = std::numeric_limits<double>::infinity();   ///< [m] > 0
    double strength = 0.0;                                         ///< c [Pa], >= 0
    /// Time in which a force that sticks falls by 1/e while nothing moves [s] > 0 (Maxwell): damps the vibration of bodies
    /// that stick, and lets them creep
    double relaxation_time = std::numeric_limits<double>::infinity();
    /// In place of mu(v, s): gives mu [-], finite and >= 0. It must depend on its argument alone
    std::function<double(const Sliding&)> own_coefficient = {};

    /// True if the law can give a force.
    [[nodiscard]] bool acts() const {
        return coefficient > 0.0 || sliding_coefficient > 0.0 || strength > 0.0 || own_coefficient;
    }
};

/// mu of a law. Throws BadInput for an `own_coefficient` that is not finite and >= 0.
[[nodiscard]] double coefficient_of(const Friction& law, const Sliding& sliding);

/// Laws of friction, and the faces between which each acts.
struct FrictionOptions {
    std::vector<Friction> laws = {};  ///< none: no friction anywhere
    /// Index in `laws` of two faces, in either order; -1: none. Asked once per pair of a candidate list, and must
    /// always give the same. Empty: the first law is that of all
    std::function<std::int32_t(Face, Face)> law_of = {};

    [[nodiscard]] bool any() const { return !laws.empty(); }
    /// Index of the law of two faces; -1: none. Throws BadInput for another index.
    [[nodiscard]] std::int32_t law_between(Face face_1, Face face_2) const;
};

/// Throws BadInput naming the value, its limit and the remedy.
void check(const FrictionOptions& options);

}  // namespace abut::contact
