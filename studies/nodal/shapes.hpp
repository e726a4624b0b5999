#pragma once
#include "abut/contact/surface/obstacle.hpp"
#include "studies/cases/shapes.hpp"

/// Bodies and obstacles that the scenes of nodal contact are made of.
namespace abut::studies::nodal {

/// A ring whose outer radius is `radius` + `height` cos(teeth (angle - phase)): flanks slope by at most teeth height/radius.
struct Gear {
    Vector<2> centre = Vector<2>::Zero();
    int teeth = 12;
    double radius = 1.0;
    double bore = 0.5;     ///< radius of the hole
    double height = 0.08;  ///< of a tooth over the radius, and depth of a gap under it
    double phase = 0.0;    ///< angle of the middle of a tooth [rad]
    int cells = 8;         ///< around a tooth
    std::string name = "gear";
};
[[nodiscard]] mesh::Mesh<2> gear(const Gear& gear);

/// The outline of a rectangle about the origin.
[[nodiscard]] contact::RigidObstacle<2> rectangle_obstacle(const Vector<2>& half_sides);

}  // namespace abut::studies::nodal
