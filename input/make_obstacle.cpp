#include "abut/input/make_obstacle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "abut/contact/obstacle.hpp"
#include "abut/input/values.hpp"

namespace abut::input {
namespace {

/// A closed outline, counter-clockwise, as segments with the outside on the right of each.
std::vector<std::vector<Vector<2>>> faces_of_outline(std::vector<Vector<2>> corners, bool inside) {
    double area = 0.0;  // twice that of the outline, < 0 if it is clockwise
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector<2>& a = corners[i];
        const Vector<2>& b = corners[(i + 1) % corners.size()];
        area += a.x() * b.y() - a.y() * b.x();
    }
    if ((area < 0.0) != inside) std::ranges::reverse(corners);
    std::vector<std::vector<Vector<2>>> faces;
    for (std::size_t i = 0; i < corners.size(); ++i) faces.push_back({corners[i], corners[(i + 1) % corners.size()]});
    return faces;
}

std::vector<std::vector<Vector<2>>> faces_of_box(const Vector<2>& lower, const Vector<2>& upper, bool inside) {
    return faces_of_outline({lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}}, inside);
}

/// Two faces for each direction; corners counter-clockwise seen from outside.
std::vector<std::vector<Vector<3>>> faces_of_box(const Vector<3>& lower, const Vector<3>& upper, bool inside) {
    std::vector<std::vector<Vector<3>>> faces;
    for (int along = 0; along < 3; ++along)
        for (const bool high : {false, true}) {
            const int a = (along + 1) % 3, b = (along + 2) % 3;
            std::vector<Vector<3>> face(4, lower);
            for (Vector<3>& corner : face) corner[along] = high ? upper[along] : lower[along];
            face[1][a] = face[2][a] = upper[a];
            face[2][b] = face[3][b] = upper[b];
            if (high == inside) std::ranges::reverse(face);
            faces.push_back(std::move(face));
        }
    return faces;
}

template <int Dim>
std::function<Vector<Dim>(double)> path_of(const ObstacleSettings& obstacle) {
    if (obstacle.path) return [path = *obstacle.path](double time) { return value_at<Dim>(path, time, Vector<3>::Zero()); };
    if (obstacle.velocity.isZero(0.0)) return {};
    return [velocity = head<Dim>(obstacle.velocity)](double time) { return Vector<Dim>(velocity * time); };
}

template <int Dim>
contact::RigidObstacle<Dim> make_obstacle(const ObstacleSettings& obstacle) {
    if (obstacle.shape == ObstacleShape::plane)
        return contact::plane_obstacle<Dim>(head<Dim>(obstacle.point), head<Dim>(obstacle.normal), obstacle.half_width,
                                            path_of<Dim>(obstacle));
    if constexpr (Dim == 2)
        if (obstacle.shape == ObstacleShape::polygon) {
            std::vector<Vector<2>> corners;
            for (const Vector<3>& corner : obstacle.corners) corners.push_back(head<2>(corner));
            return {faces_of_outline(std::move(corners), obstacle.inside), path_of<2>(obstacle)};
        }
    return {faces_of_box(head<Dim>(obstacle.lower), head<Dim>(obstacle.upper), obstacle.inside), path_of<Dim>(obstacle)};
}

}  // namespace

template <int Dim>
void add_obstacles(run::Scene<Dim>& scene, const Settings& settings, std::vector<Fault>& faults) {
    for (const ObstacleSettings& obstacle : settings.obstacles) {
        if (obstacle.shape == ObstacleShape::none) continue;
        if (obstacle.shape == ObstacleShape::box &&
            !(head<Dim>(obstacle.lower).array() < head<Dim>(obstacle.upper).array()).all()) {
            faults.push_back({obstacle.where,
                              fmt::format("obstacles.{}: lower has to be below upper in every component.", obstacle.name)});
            continue;
        }
        scene.solid.obstacles.push_back(make_obstacle<Dim>(obstacle));
    }
}

template void add_obstacles<2>(run::Scene<2>&, const Settings&, std::vector<Fault>&);
template void add_obstacles<3>(run::Scene<3>&, const Settings&, std::vector<Fault>&);

}  // namespace abut::input
