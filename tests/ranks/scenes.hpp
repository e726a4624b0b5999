#pragma once
// Small scenes whose bits several ranks must have.
#include <cmath>
#include <vector>

#include "abut/mesh/shapes/shapes.hpp"
#include "abut/run/scene.hpp"

namespace abut::test {

/// Two discs or short cylinders that meet head-on after a few steps; E = 2 Pa, rho = 1.5 kg/m^3.
template <int Dim>
run::Scene<Dim> meeting_bodies(double size) {
    run::Scene<Dim> scene;
    std::vector<mesh::Mesh<Dim>> bodies;
    for (int i = 0; i < 2; ++i) {
        Vector<Dim> centre = Vector<Dim>::Zero();
        centre[0] = i == 0 ? -1.002 : 1.002;
        if constexpr (Dim == 2)
            bodies.push_back(mesh::disc({.centre = centre, .size = size * (1.0 + 0.1 * i), .variant = i}));
        else
            bodies.push_back(
                mesh::cylinder({.centre = centre, .length = 0.5, .size = size * (1.0 + 0.1 * i), .variant = i}));
    }
    scene.mesh = mesh::combine<Dim>(bodies);
    scene.solid.materials = {{.young = 2.0, .poisson = 0.3, .density = 1.5}, {.young = 1.0, .poisson = 0.2, .density = 1.0}};
    scene.velocity = {0.1 * Vector<Dim>::Unit(0), -0.1 * Vector<Dim>::Unit(0)};
    return scene;
}

/// A strip that is held at one end by a support that moves, pulled by a traction that varies, heavy, and met by a wall from
/// below.
inline run::Scene<2> loaded_strip() {
    run::Scene<2> scene;
    scene.mesh = mesh::structured_box<2>({0.0, 0.0}, {4.0, 0.5}, {48, 6}, mesh::CellShape::triangle, "strip");
    scene.solid.materials = {{.young = 2.0, .poisson = 0.3, .density = 1.5}};
    scene.solid.acceleration = {Vector<2>(0.0, -0.3)};
    scene.solid.boundary.dirichlet = {{.group = "xmin", .history = [](double t, const Vector<2>&) -> Vector<2> {
                                           return {0.0, 0.01 * std::sin(5.0 * t)};
                                       }}};
    scene.solid.boundary.traction = {{.group = "ymax", .history = [](double t, const Vector<2>& x) -> Vector<2> {
                                          return {0.0, -0.02 * std::sin(3.0 * t + x[0])};
                                      }}};
    scene.solid.obstacles = {
        {.faces = {{Vector<2>(5.0, -0.002), Vector<2>(-1.0, -0.002)}}, .path = [](double t) -> Vector<2> {
             return {0.0, 0.01 * t};
         }}};
    scene.velocity = {Vector<2>(0.0, -0.05)};
    scene.energy_scale = {.name = "E0", .value = 0.01};
    return scene;
}

/// Two bars along x whose ends are bonded, run into each other and pass each other: the bond is sheared off while they press.
inline run::Scene<2> sheared_bars(bool are_grains) {
    run::Scene<2> scene;
    const auto bar = [](double from, const char* name) {
        return mesh::structured_box<2>({from, -0.125}, {from + 1.0, 0.125}, {20, 5}, mesh::CellShape::quadrangle, name);
    };
    scene.mesh = mesh::combine<2>(std::vector{bar(-1.0, "left"), bar(0.0, "right")});
    scene.solid.materials.assign(2, {.young = 1.0, .poisson = 0.0, .density = 1.0});
    scene.solid.kinematics.assign(2, solid::Kinematics::floating);
    scene.solid.bonds = {{.sides = {0, 1},
                          .strength = 0.0015,
                          .fracture_energy = 3e-6,
                          .weibull_modulus = 5.0,  // places break one after the other
                          .of_grains = are_grains}};
    scene.velocity = {Vector<2>(0.02, 0.006), Vector<2>(-0.02, -0.006)};
    return scene;
}

}  // namespace abut::test
