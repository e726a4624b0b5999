#pragma once
#include <cmath>

#include "abut/contact/surface/obstacle.hpp"
#include "studies/cases/shapes.hpp"

/// Bodies and obstacles of the scenes.
namespace abut::studies::kinematics {

/// A regular polygon; its first corner is at the angle `turn` [rad]. Each of its sides is cut in `cuts`, and the triangle
/// from there to the centre in cuts^2 cells.
struct Polygon {
    Vector<2> centre = Vector<2>::Zero();
    double radius = 1.0;
    int corners = 6;
    int cuts = 2;
    double turn = 0.0;
    std::string name = "polygon";
};
[[nodiscard]] mesh::Mesh<2> polygon(const Polygon& polygon);

/// A polyhedron on a sphere: a core of tetrahedra from the centre and a skin of prisms. `circles` of latitude about the
/// x axis carry `around` corners each; the caps beyond the first and the last are flat, at right angles to the axis,
/// and the one in front is the wider one: caps as wide as each other would slide off, since pressing them in costs less
/// the less they overlap.
struct Ball {
    Vector<3> centre = Vector<3>::Zero();
    double radius = 1.0;
    double skin = 0.1;   ///< of the distance from the centre
    double front = 0.4;  ///< from the axis to the rim of the cap at x > 0, seen from the centre [rad]
    double back = 0.3;   ///< the same at x < 0
    int circles = 5;
    int around = 8;
    std::string name = "ball";

    [[nodiscard]] double front_distance() const { return radius * std::cos(front); }  ///< of that cap from the centre [m]
    [[nodiscard]] double back_distance() const { return radius * std::cos(back); }
    [[nodiscard]] double back_area() const;  ///< of that cap [m^2]
    /// |c|/|f| of the cells behind a cap, as a part of its distance from the centre.
    [[nodiscard]] double depth() const { return (1.0 - std::pow(1.0 - skin, 3)) / 3.0; }
};
[[nodiscard]] mesh::Mesh<3> faceted_ball(const Ball& ball);

/// Segments from one point to the next, which bodies touch from their left side.
[[nodiscard]] contact::RigidObstacle<2> wall_along(const std::vector<Vector<2>>& points);

}  // namespace abut::studies::kinematics
