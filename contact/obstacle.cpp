#include "abut/contact/obstacle.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {

template <int Dim>
RigidObstacle<Dim> plane_obstacle(const Vector<Dim>& point, const Vector<Dim>& normal, double half_width,
                                  std::function<Vector<Dim>(double time)> path) {
    if (!(normal.norm() > 0.0) || !normal.allFinite())
        throw BadInput("plane obstacle: its normal is zero or not finite. Give the direction it faces.");
    if (!(half_width > 0.0) || !std::isfinite(half_width))
        throw BadInput("plane obstacle: its half width is " + number(half_width) +
                       " m; it must be finite and > 0. Give more than the bodies can reach.");
    const geometry::PlaneFrame<Dim> frame(normal.normalized());
    std::vector<Vector<Dim>> corners;
    if constexpr (Dim == 2) {
        // The outside is on the right of the line from the first corner to the second.
        const Vector<2> along = half_width * frame.tangents();
        corners = {point - along, point + along};
    } else {
        const Vector<3> a = half_width * frame.tangents().col(0);
        const Vector<3> b = half_width * frame.tangents().col(1);
        corners = {point - a - b, point + a - b, point + a + b, point - a + b};
    }
    return {{std::move(corners)}, std::move(path)};
}

template <int Dim>
void append(Surface<Dim>& surface, const RigidObstacle<Dim>& obstacle, std::int32_t body) {
    for (const auto& corners : obstacle.faces) surface.append(corners, 0.0, std::numeric_limits<double>::infinity(), body);
}

template RigidObstacle<2> plane_obstacle<2>(const Vector<2>&, const Vector<2>&, double, std::function<Vector<2>(double)>);
template RigidObstacle<3> plane_obstacle<3>(const Vector<3>&, const Vector<3>&, double, std::function<Vector<3>(double)>);
template void append<2>(Surface<2>&, const RigidObstacle<2>&, std::int32_t);
template void append<3>(Surface<3>&, const RigidObstacle<3>&, std::int32_t);

}  // namespace abut::contact
