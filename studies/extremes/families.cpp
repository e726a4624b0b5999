#include "studies/extremes/families.hpp"

namespace abut::studies::extremes {

const std::vector<Family>& families() {
    static const std::vector<Family> all = {
        {"units", "metres, pascals and kg/m^3 taken 1e-9 to 1e9 times: does any number without a unit change?", sweep_units},
        {"offset", "the scene up to 1e6 sizes from the origin", sweep_offset},
        {"stiffness", "Young's moduli of the two bodies up to 1e12 apart", sweep_stiffness},
        {"density", "densities of the two bodies up to 1e9 apart", sweep_density},
        {"poisson", "nu from 0 to 0.4999", sweep_poisson},
        {"speed", "speeds from 1e-6 of the wave speed until the run is refused", sweep_speed},
        {"cfl", "time steps from 0.1 to 0.999 of the stable one", sweep_cfl},
        {"aspect", "cells up to 1e4 times as long as wide", sweep_aspect},
        {"refinement", "cells across the contact up to 100 times smaller", sweep_refinement},
        {"thickness", "plates of one, two and four cells", sweep_thickness},
        {"wedge", "a tip that comes down on a plane and on a block", sweep_wedge},
        {"corner", "a square that comes down with a corner on the flat side of a block", sweep_corner},
        {"crossing", "beams with edges of 60 to 100 degrees that cross at right angles", sweep_crossing},
        {"edge", "a block that presses on another and slides off its edge or corner", sweep_edge},
        {"spin", "a bar that spins freely: how far it has turned, and how much it has grown", sweep_spin},
        {"rim", "discs that meet while one spins, its rim up to the wave speed", sweep_rim},
        {"turns", "blocks that spin freely for up to 1,000 turns", sweep_turns},
        {"sizes", "a disc on a block up to 1,000 times as large", sweep_sizes},
        {"masses", "a rigid disc on an elastic block, densities up to 1e6 apart", sweep_masses},
        {"rollers", "blocks that run into each other along their rollers, with and without the filter", sweep_rollers},
        {"crowd", "many discs that run into one another at once", sweep_crowd},
        {"long", "bodies that bounce for --steps steps", sweep_long},
        {"rest", "a block that lies on a plane under gravity for --steps steps", sweep_rest},
    };
    return all;
}

std::vector<double> thinned(const std::vector<double>& values, bool quick) {
    if (!quick || values.size() <= 3) return values;
    return {values.front(), values[values.size() / 2], values.back()};
}

}  // namespace abut::studies::extremes
