#include "abut/contact/surface/obstacle.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "abut/base/error.hpp"
#include "abut/base/messages.hpp"
#include "abut/geometry/plane_frame.hpp"

namespace abut::contact {

namespace {

template <int Dim>
geometry::PlaneFrame<Dim> checked_frame(const Vector<Dim>& normal, double half_width) {
    if (!(normal.norm() > 0.0) || !normal.allFinite())
        throw BadInput("plane obstacle: its normal is zero or not finite. Give the direction it faces.");
    if (!(half_width > 0.0) || !std::isfinite(half_width))
        throw BadInput("plane obstacle: its half width is " + number(half_width) +
                       " m; it must be finite and > 0. Give more than the bodies can reach.");
    return geometry::PlaneFrame<Dim>(normal.normalized());
}

}  // namespace

template <int Dim>
RigidObstacle<Dim> plane_obstacle(const Vector<Dim>& point, const Vector<Dim>& normal, double half_width,
                                  std::function<Vector<Dim>(double time)> path) {
    const geometry::PlaneFrame<Dim> frame = checked_frame<Dim>(normal, half_width);
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
RigidObstacle<Dim> endless_plane_obstacle(const Vector<Dim>& point, const Vector<Dim>& normal, const Vector<Dim>& middle,
                                          double reach, std::function<Vector<Dim>(double time)> path) {
    const geometry::PlaneFrame<Dim> frame = checked_frame<Dim>(normal, reach);
    const Vector<Dim> foot = middle - frame.normal().dot(middle - point) * frame.normal();
    if constexpr (Dim == 2) return plane_obstacle<2>(foot, normal, reach, std::move(path));
    if constexpr (Dim == 3) {
        // The triangle around a circle of that radius, counter-clockwise about the normal.
        const Vector<3> a = std::sqrt(3.0) * reach * frame.tangents().col(0), b = reach * frame.tangents().col(1);
        return {{{foot - a - b, foot + a - b, foot + 2.0 * b}}, std::move(path)};
    }
}

template <int Dim>
void append(Surface<Dim>& surface, const RigidObstacle<Dim>& obstacle, std::int32_t body) {
    for (const auto& corners : obstacle.faces) surface.append(corners, 0.0, std::numeric_limits<double>::infinity(), body);
}

#define ABUT_INSTANTIATE(Dim)                                                                                           \
    template RigidObstacle<Dim> plane_obstacle<Dim>(const Vector<Dim>&, const Vector<Dim>&, double,                     \
                                                    std::function<Vector<Dim>(double)>);                                \
    template RigidObstacle<Dim> endless_plane_obstacle<Dim>(const Vector<Dim>&, const Vector<Dim>&, const Vector<Dim>&, \
                                                            double, std::function<Vector<Dim>(double)>);                \
    template void append<Dim>(Surface<Dim>&, const RigidObstacle<Dim>&, std::int32_t);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::contact
