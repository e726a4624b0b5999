#pragma once
// A body that falls on another one, which lies on a wall.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "abut/contact/surface/obstacle.hpp"
#include "abut/solid/outside_view.hpp"
#include "solid/turning_scenes.hpp"

namespace abut::test {

using solid::Kinematics;

template <int Dim>
mesh::Mesh<Dim> stacked() {
    if constexpr (Dim == 2)
        return together(mesh::structured_box<2>({-1.0, 0.0}, {1.0, 0.6}, {8, 3}, CellShape::quadrangle, "lower"),
                        mesh::structured_box<2>({-0.55, 0.61}, {0.3, 1.2}, {5, 4}, CellShape::triangle, "upper"));
    else
        return together(
            mesh::structured_box<3>({-1.0, -1.0, 0.0}, {1.0, 1.0, 0.6}, {4, 3, 2}, CellShape::hexahedron, "lower"),
            mesh::structured_box<3>({-0.5, -0.4, 0.61}, {0.3, 0.7, 1.2}, {3, 3, 2}, CellShape::tetrahedron, "upper"));
}

template <int Dim>
solid::SolidOptions<Dim> falling(const std::vector<Kinematics>& kinematics) {
    solid::SolidOptions<Dim> options = bodies<Dim>(2);
    options.kinematics = kinematics;
    if (std::ranges::count(kinematics, Kinematics::small) == 2) options.law = solid::ContactLaw::reconstruction;
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    options.acceleration.assign(2, -0.01 * up);
    options.obstacles = {contact::plane_obstacle<Dim>(-0.005 * up, up, 6.0)};
    return options;
}

template <int Dim>
std::string top() {
    return Dim == 2 ? "upper.ymax" : "upper.zmax";
}

/// A wall that moves, tractions that vary.
template <int Dim>
solid::SolidOptions<Dim> driven(const std::vector<Kinematics>& kinematics) {
    solid::SolidOptions<Dim> options = falling<Dim>(kinematics);
    const Vector<Dim> up = Vector<Dim>::Unit(Dim - 1);
    options.obstacles[0].path = [up](double t) { return Vector<Dim>(0.002 * std::sin(3.0 * t) * up); };
    options.boundary.traction = {{.group = top<Dim>(), .history = [up](double t, const Vector<Dim>& x) {
                                      return Vector<Dim>(-0.01 * (1.0 + std::sin(2.0 * t + x[0])) * up);
                                  }}};
    return options;
}

/// Dashpots and a brake.
template <int Dim>
solid::SolidOptions<Dim> tied(const std::vector<Kinematics>& kinematics) {
    solid::SolidOptions<Dim> options = falling<Dim>(kinematics);
    solid::Spring<Dim> spring;
    spring.first = {.body = 1, .position = Vector<Dim>::Constant(0.1) + 0.9 * Vector<Dim>::Unit(Dim - 1), .radius = 0.3};
    spring.second.position = Vector<Dim>::Constant(1.5);
    spring.stiffness = 0.05;
    spring.length = 0.5;
    spring.damping = 0.02;
    options.springs = {spring};
    solid::BodyMoment<Dim> brake;
    brake.body = 1;
    brake.damping = 0.01;
    options.moments = {brake};
    return options;
}

template <int Dim>
std::vector<Motion<Dim>> thrown() {
    const Vector<Dim> down = -0.08 * Vector<Dim>::Unit(Dim - 1);
    return {Motion<Dim>(), moving<Dim>(down + 0.02 * Vector<Dim>::Unit(0), AxialVector<Dim>::Constant(0.05))};
}

/// As another program does: a traction that it sets before each step.
template <int Dim>
solid::SolidOptions<Dim> pushed(const std::vector<Kinematics>& kinematics) {
    solid::SolidOptions<Dim> options = falling<Dim>(kinematics);
    options.boundary.traction = {{.group = top<Dim>(), .from_outside = true}};
    return options;
}
template <int Dim>
void push(solid::Solid<Dim>& solid, std::int64_t step) {
    if (solid.options().boundary.traction.empty() || !solid.options().boundary.traction[0].from_outside) return;
    std::vector<Vector<Dim>> traction(solid.outside(top<Dim>()).traction().size());
    for (std::size_t i = 0; i < traction.size(); ++i)
        traction[i] = -0.01 * (1.0 + 0.1 * static_cast<double>(i) + 0.5 * std::sin(0.2 * static_cast<double>(step / 4))) *
                      Vector<Dim>::Unit(Dim - 1);
    solid.set_traction(top<Dim>(), traction);
}

}  // namespace abut::test
