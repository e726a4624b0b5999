#pragma once
#include "studies/cases/case.hpp"

/// Scenes of bodies that turn, E = rho = 1 and nu = 0.3 throughout. `size`: of a cell [m]; `cells`: along a side.
namespace abut::studies::nodal {

/// Two discs of radius 1 (cylinders of length 1) that meet off-centre at 0.05 each, and slip.
[[nodiscard]] Case<2> slipping_discs(Kinematics strain, double size);
[[nodiscard]] Case<3> slipping_cylinders(Kinematics strain, double size);

/// The same discs, which spin, too.
[[nodiscard]] Case<2> spinning_discs(double size);
/// A block that turns as it falls on a rigid plane, again and again.
[[nodiscard]] Case<2> tumbling_block(int cells);
/// Two gears on axles; the first one turns faster at first, and drives the other. `turns` of the first.
[[nodiscard]] Case<2> gears(int cells_around_tooth, double turns);
/// A rigid bar on a given path, which turns once and strikes two discs on springs.
[[nodiscard]] Case<2> rotor(double size);
/// Two cubes that spin about different axes and meet; `cells` along a side of the first, one more along the other.
[[nodiscard]] Case<3> spinning_cubes(int cells);
/// A cube that falls on a rigid plane with a corner first.
[[nodiscard]] Case<3> cube_on_corner(int cells);

/// A disc that flies to and fro between two rigid walls.
[[nodiscard]] Case<2> disc_between_walls(Kinematics strain, double size);

}  // namespace abut::studies::nodal
