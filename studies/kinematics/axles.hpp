#pragma once
#include <cstdint>

#include "abut/dynamics/ledger.hpp"
#include "abut/solid/solid.hpp"

/// Bodies of the plane that turn about axles.
namespace abut::studies::kinematics {

/// How far a body has turned, fitted to its points [rad], from -pi to pi.
[[nodiscard]] double angle_of(const dynamics::RunView<2>& run, const solid::Solid<2>& solid, std::int32_t body);

/// A body as a whole.
struct Centre {
    Vector<2> shift = Vector<2>::Zero();     ///< of the centre of mass, from where it is at rest [m]
    Vector<2> momentum = Vector<2>::Zero();  ///< [kg m/s]
};
[[nodiscard]] Centre centre_of(const dynamics::RunView<2>& run, const solid::Solid<2>& solid, std::int32_t body);

/// sum (x - point) × p over the points of a body [kg m^2/s].
[[nodiscard]] double angular_momentum_about(const Vector<2>& point, const dynamics::RunView<2>& run,
                                            const solid::Solid<2>& solid, std::int32_t body);

/// An angle that goes on beyond pi, followed in steps of less than that.
class Turning {
public:
    void follow(double angle);
    [[nodiscard]] double total() const { return total_; }  ///< [rad]

private:
    double before_ = 0.0, total_ = 0.0;
};

}  // namespace abut::studies::kinematics
