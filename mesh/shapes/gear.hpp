#pragma once
#include <string>

#include "abut/mesh/mesh.hpp"

namespace abut::mesh {

/// A ring of quadrangles with involute teeth: their tips a module over the pitch circle, the ground of the gaps 1.25 modules
/// below it, a module being twice the radius of that circle over the number of teeth. Flanks are radial within the base
/// circle. Two gears with equal modules, pressure angles and `cells` mesh where their pitch circles touch.
struct Gear {
    Vector<2> centre = Vector<2>::Zero();
    int teeth = 12;
    double radius = 1.0;          ///< of the pitch circle [m]
    double bore = 0.4;            ///< radius of the hole [m]
    double pressure_angle = 0.0;  ///< [rad]
    double backlash = 0.0;        ///< by how much a tooth is thinner than a gap on the pitch circle, halved [m]
    double phase = 0.0;           ///< angle of the middle of a tooth [rad]
    int cells = 4;                ///< across a tooth; even
    std::string name = "gear";
};
/// Boundary groups: teeth, bore. Throws MeshError naming the value, the limit and the remedy for sizes that make no gear,
/// and more cells than most_structured_cells (mesh/shapes/shapes.hpp) or MeshOptions::most_cells.
[[nodiscard]] Mesh<2> gear(const Gear& gear, const MeshOptions& mesh_options = {});
/// By which angle the right flank of a tooth lies from its middle at this distance from the centre [rad].
[[nodiscard]] double half_tooth(const Gear& gear, double radius);

}  // namespace abut::mesh
