// Two elastic cylinders collide head-on and rebound: rho u'' = div sigma in each, no friction.
//
// Radius 1, E = 1, nu = 0.3, rho = 1 each, at speeds of +-0.05 along x, the centres at one height; 2D (plane strain) or 3D.
// Equal bodies exchange their velocities, except for the part of the energy that stays behind as vibration: expect final
// speeds of 0.9 to 1 times 0.05 along x and none along y up to the asymmetry of the meshes, a drift of the pseudo-energy H~
// below 1e-11 K0 and of momentum below 1e-12 m v, and H - H~ below 1 % of K0.
#include "apps/two_cylinders.hpp"

int main(int argc, char** argv) {
    return abut::apps::run_two_cylinders(argc, argv,
                                         {.program = "rebounding_cylinders",
                                          .purpose = "Two elastic cylinders collide head-on and rebound.",
                                          .offset_over_radius = 0.0});
}
