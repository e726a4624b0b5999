#pragma once
#include "abut/contact/obstacle.hpp"
#include "abut/mesh/mesh.hpp"

/// Bodies and obstacles of the scenes.
namespace abut::studies::kinematics {

/// A box of simplices about `centre`, in the plane turned by `angle`.
template <int Dim>
struct Block {
    Vector<Dim> centre = Vector<Dim>::Zero();
    Vector<Dim> sides = Vector<Dim>::Ones();
    std::array<int, Dim> cells{};
    Matrix<Dim> turn = Matrix<Dim>::Identity();
    std::string name = "block";
};
template <int Dim>
[[nodiscard]] mesh::Mesh<Dim> block(const Block<Dim>& block);

/// By this angle [rad], counter-clockwise.
[[nodiscard]] Matrix<2> rotation(double angle);

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

/// Segments from one point to the next, which bodies touch from their left side.
[[nodiscard]] contact::RigidObstacle<2> wall_along(const std::vector<Vector<2>>& points);

}  // namespace abut::studies::kinematics
