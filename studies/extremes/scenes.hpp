#pragma once
#include <array>

#include "abut/run/scene.hpp"

/// Small scenes whose every number can be taken to extremes.
namespace abut::studies::extremes {

/// Units of which lengths, stresses and densities of a scene are multiples, SI.
struct Units {
    double length = 1.0;   ///< [m]
    double stress = 1.0;   ///< [Pa]
    double density = 1.0;  ///< [kg/m^3]

    [[nodiscard]] double speed() const;  ///< sqrt(stress / density) [m/s]
    [[nodiscard]] double time() const;   ///< length / speed [s]
};

/// Two bodies that run into each other, in `Units`; the first number of a pair is the body below or on the left.
template <int Dim>
struct Meeting {
    Units units = {};
    std::array<double, 2> young{1.0, 1.0};
    std::array<double, 2> density{1.0, 1.0};
    double poisson = 0.3;
    double speed = 0.05;                      ///< of each
    double gap = 0.02;                        ///< between their nearest points
    double aside = 0.0;                       ///< of the second, at right angles to their path, over its size
    double slide = 0.0;                       ///< speed of the second at right angles to its path
    double time = 12.0;                       ///< of the run
    Vector<Dim> place = Vector<Dim>::Zero();  ///< of the first point of contact
};

/// Two discs of radius 1, cells of the given sizes; they meet along x.
[[nodiscard]] run::Scene<2> discs(const Meeting<2>& meeting, std::array<double, 2> size = {0.3, 0.3});

/// A structured box: sides, and cells along them.
template <int Dim>
struct Block {
    Vector<Dim> sides = Vector<Dim>::Ones();
    std::array<int, Dim> cells{};
    mesh::CellShape shape = Dim == 2 ? mesh::CellShape::quadrangle : mesh::CellShape::tetrahedron;
};
/// Two blocks, one above the other along the last axis, with their middles in line.
template <int Dim>
[[nodiscard]] run::Scene<Dim> blocks(const Meeting<Dim>& meeting, const std::array<Block<Dim>, 2>& blocks);

/// A triangle whose tip, of this angle [rad], comes down on the middle of a block, or on a rigid plane.
[[nodiscard]] run::Scene<2> wedge(const Meeting<2>& meeting, double angle, bool on_plane);

/// A square of side 1 that comes down with a corner on the middle of a block of sides 2 and 1 at rest; so many cells along
/// 1.
[[nodiscard]] run::Scene<2> square_on_corner(const Meeting<2>& meeting, int cells);

/// Two beams of length 2 and sides 0.5, their sections rhombi with this angle [rad] above and below, which meet at right
/// angles, edge on edge.
[[nodiscard]] run::Scene<3> crossing_beams(const Meeting<3>& meeting, double angle);

/// Two unit blocks that run into each other along their rollers, which is the last axis.
template <int Dim>
[[nodiscard]] run::Scene<Dim> blocks_on_rollers(const Meeting<Dim>& meeting);

/// How much wider and higher a cell is than at rest.
struct Growth {
    double of_cell = 0.0;  ///< [-]
    double time = 0.0;     ///< when it was measured [s]
};
/// A bar of sides 2 and 0.5 that spins freely, this fast [rad/s], until it has turned by `angle` [rad]. `growth` becomes
/// that of a cell halfway through the last step; it must outlive the run.
[[nodiscard]] run::Scene<2> spinning_bar(double rate, double angle, Growth& growth);

/// n x n discs of diameter 1 - gap that all fly towards the middle, each as fast as it is far from it.
[[nodiscard]] run::Scene<2> crowd(int n, double speed, double gap);

/// A block that rests on a rigid plane under gravity from the start on, without having been loaded before: it settles and
/// vibrates for ever. `load`: its weight over its foot, over Young's modulus.
[[nodiscard]] run::Scene<2> resting(double load);

/// A disc that flies to and fro between two rigid walls, off-centre by nothing and without gravity.
[[nodiscard]] run::Scene<2> between_walls(double speed);

/// A strip of squares, two across, nu = 0, that falls on a rigid plane from as high as half its length, again and again.
[[nodiscard]] run::Scene<2> falling_strip(int cells);

}  // namespace abut::studies::extremes
