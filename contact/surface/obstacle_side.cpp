#include "abut/contact/surface/obstacle_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "abut/geometry/polygon.hpp"

namespace abut::contact {
namespace {

constexpr double same_distance = 1e-9;  // of two faces from a point, in units of it

template <int Dim>
Vector<Dim> nearest_on_segment(const Vector<Dim>& a, const Vector<Dim>& b, const Vector<Dim>& point) {
    const Vector<Dim> along = b - a;
    const double length_squared = along.squaredNorm();
    if (!(length_squared > 0.0)) return a;
    return a + std::clamp((point - a).dot(along) / length_squared, 0.0, 1.0) * along;
}

/// From the point of a flat convex face that is nearest.
template <int Dim>
Vector<Dim> from_nearest(std::span<const Vector<Dim>> corners, const Vector<Dim>& normal, const Vector<Dim>& point) {
    if constexpr (Dim == 2) {
        return point - nearest_on_segment<2>(corners[0], corners[1], point);
    } else {
        bool is_over = true;
        Vector<3> nearest = corners[0];
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vector<3>&a = corners[i], b = corners[(i + 1) % corners.size()];
            if (normal.dot(moment<3>(b - a, point - a)) < 0.0) is_over = false;
            const Vector<3> on_edge = nearest_on_segment<3>(a, b, point);
            if ((point - on_edge).squaredNorm() < (point - nearest).squaredNorm()) nearest = on_edge;
        }
        if (is_over) return normal.dot(point - corners[0]) * normal;
        return point - nearest;
    }
}

}  // namespace

template <int Dim>
double side_of(std::span<const std::vector<Vector<Dim>>> faces, const Vector<Dim>& point) {
    double least = std::numeric_limits<double>::infinity(), steepest = 0.0;
    for (const std::vector<Vector<Dim>>& corners : faces) {
        const Vector<Dim> normal = geometry::face_normal<Dim>(corners);
        const Vector<Dim> away = from_nearest<Dim>(corners, normal, point);
        const double distance = away.norm();
        if (distance > least * (1.0 + same_distance)) continue;
        const double height = normal.dot(away);
        if (distance < least * (1.0 - same_distance) || std::abs(height) > std::abs(steepest)) steepest = height;
        least = std::min(least, distance);
    }
    return steepest < 0.0 ? -least : least;
}

template <int Dim>
Placement<Dim> placement_at(const RigidObstacle<Dim>& obstacle, double time) {
    if (obstacle.placement) return obstacle.placement(time);
    return {.offset = obstacle.path ? obstacle.path(time) : Vector<Dim>::Zero()};
}

template Placement<2> placement_at<2>(const RigidObstacle<2>&, double);
template Placement<3> placement_at<3>(const RigidObstacle<3>&, double);
template double side_of<2>(std::span<const std::vector<Vector<2>>>, const Vector<2>&);
template double side_of<3>(std::span<const std::vector<Vector<3>>>, const Vector<3>&);

}  // namespace abut::contact
