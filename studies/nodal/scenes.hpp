#pragma once
#include "studies/nodal/impact.hpp"

/// Scenes of bodies that turn, E = rho = 1 and nu = 0.3 throughout. `size`: of a cell [m]; `cells`: along a side.
namespace abut::studies::nodal {

/// Two discs of radius 1 (cylinders of length 1) that meet off-centre at 0.05 each, and slip.
[[nodiscard]] Impact<2> slipping_discs(Strain strain, double size);
[[nodiscard]] Impact<3> slipping_cylinders(Strain strain, double size);

/// The same discs, which spin, too.
[[nodiscard]] Impact<2> spinning_discs(double size);
/// A block that turns as it falls on a rigid plane, again and again.
[[nodiscard]] Impact<2> tumbling_block(int cells);
/// Two gears on axles; the first one turns faster at first, and drives the other. `turns` of the first.
[[nodiscard]] Impact<2> gears(int cells_around_tooth, double turns);
/// A rigid bar on a given path, which turns once and strikes two discs on springs.
[[nodiscard]] Impact<2> rotor(double size);
/// Two cubes that spin about different axes and meet; `cells` along a side of the first, one more along the other.
[[nodiscard]] Impact<3> spinning_cubes(int cells);
/// A cube that falls on a rigid plane with a corner first.
[[nodiscard]] Impact<3> cube_on_corner(int cells);

/// A disc that flies to and fro between two rigid walls.
[[nodiscard]] Impact<2> disc_between_walls(Strain strain, double size);

}  // namespace abut::studies::nodal
