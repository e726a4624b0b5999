#pragma once
#include "abut/contact/surface/obstacle.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/scene.hpp"

namespace abut::test {

/// A block of 2 x 2 squares, E = 1 Pa and rho = 1 kg/m^3, that flies down onto a rigid plane at y = 0 from 1 mm above it.
inline run::Scene<2> block_on_plane(double speed) {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 1e-3}, {1.0, 1.0 + 1e-3}, {2, 2}, mesh::CellShape::quadrangle, "block");
    scene.solid.materials = {{.young = 1.0, .poisson = 0.0, .density = 1.0}};
    scene.solid.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), 4.0)};
    scene.velocity = {Vector<2>(0.0, -speed)};
    scene.time = 2.0;
    return scene;
}

}  // namespace abut::test
