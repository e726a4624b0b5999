#include "studies/kinematics/axles.hpp"

#include <cmath>
#include <numbers>

namespace abut::studies::kinematics {
namespace {

template <class F>
void for_points_of(const solid::Solid<2>& solid, std::int32_t body, const F& f) {
    for (std::size_t i = 0; i < solid.masses().size(); ++i)
        if (solid.body_of_points()[i] == body) f(i);
}

}  // namespace

double angle_of(const dynamics::RunView<2>& run, const solid::Solid<2>& solid, std::int32_t body) {
    const auto q = as_vectors<2>(run.q);
    Vector<2> rest = Vector<2>::Zero(), shift = Vector<2>::Zero();
    double mass = 0.0, across = 0.0, along = 0.0;
    for_points_of(solid, body, [&](std::size_t i) {
        mass += solid.masses()[i];
        rest += solid.masses()[i] * solid.rest_positions()[i];
        shift += solid.masses()[i] * q[i];
    });
    for_points_of(solid, body, [&](std::size_t i) {
        const Vector<2> at_rest = solid.rest_positions()[i] - rest / mass, now = at_rest + q[i] - shift / mass;
        across += solid.masses()[i] * moment<2>(at_rest, now)[0];
        along += solid.masses()[i] * at_rest.dot(now);
    });
    return std::atan2(across, along);
}

Centre centre_of(const dynamics::RunView<2>& run, const solid::Solid<2>& solid, std::int32_t body) {
    const auto q = as_vectors<2>(run.q);
    Centre centre;
    double mass = 0.0;
    for_points_of(solid, body, [&](std::size_t i) {
        mass += solid.masses()[i];
        centre.shift += solid.masses()[i] * q[i];
        centre.momentum += run.momentum(static_cast<std::ptrdiff_t>(i));
    });
    centre.shift /= mass;
    return centre;
}

double angular_momentum_about(const Vector<2>& point, const dynamics::RunView<2>& run, const solid::Solid<2>& solid,
                              std::int32_t body) {
    const auto q = as_vectors<2>(run.q);
    double sum = 0.0;
    for_points_of(solid, body, [&](std::size_t i) {
        const Vector<2> arm = solid.rest_positions()[i] + q[i] - point;
        sum += moment<2>(arm, run.momentum(static_cast<std::ptrdiff_t>(i)))[0];
    });
    return sum;
}

void Turning::follow(double angle) {
    total_ += std::remainder(angle - before_, 2.0 * std::numbers::pi);
    before_ = angle;
}

}  // namespace abut::studies::kinematics
