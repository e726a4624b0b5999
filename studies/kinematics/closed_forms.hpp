#pragma once
#include <vector>

#include "abut/base/vector.hpp"

namespace abut::studies::kinematics {

/// Principal moments of inertia of a box of density 1 about its centre [kg m^2].
[[nodiscard]] Vector<3> inertia_of_box(const Vector<3>& sides);

/// Rotation of a free body with I_1 = I_2 that starts unturned: it precesses about L and spins about its own axis.
[[nodiscard]] Matrix<3> symmetric_top(const Vector<3>& inertia, const Vector<3>& spin, double time);

/// From one flip to the next of a free body with rising moments of inertia: twice the quarter period of sn, from the energy
/// and |L| (Landau and Lifshitz, Mechanics, paragraph 37) [s].
[[nodiscard]] double flip_period(const Vector<3>& inertia, const Vector<3>& spin);

/// w/L of the tip of a cantilever that neither shears nor stretches under a dead load across it, alpha = P L^2/(E I)
/// (Bisshopp and Drucker, Quart. Appl. Math. 3 (1945) 272-275).
[[nodiscard]] double elastica_tip(double alpha);

/// The angle of the rotation from a to b [rad].
[[nodiscard]] double angle_between(const Matrix<3>& a, const Matrix<3>& b);

/// Equal point masses in a row, with springs between neighbours that push where these are nearer than at the start by more
/// than the gap; the first one comes with a speed.
struct Chain {
    int masses = 5;
    double mass = 1.0;       ///< [kg]
    double stiffness = 1.0;  ///< [N/m]
    double gap = 0.0;        ///< [m]
    double speed = 1.0;      ///< [m/s]
};
/// Velocities at a time over that of the first at the start, by a million steps of velocity Verlet.
[[nodiscard]] std::vector<double> velocities_of(const Chain& chain, double time);

/// The first root of an increasing or decreasing f between two times, by bisection.
template <class F>
[[nodiscard]] double root(double low, double high, const F& f) {
    const bool sign = f(low) > 0.0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        ((f(middle) > 0.0) == sign ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace abut::studies::kinematics
