// Two elastic cylinders collide off-centre, slip over each other and part: rho u'' = div sigma, no friction.
//
// Radius 1, E = 1, nu = 0.3, rho = 1 each, at speeds of +-0.05 along x, the centres 0.8 apart along y; 2D (plane strain) or
// 3D. Contact is local to a few faces, changes all the time, and still the pseudo-energy H~ is conserved to round-off:
// expect a drift below 1e-11 K0 and of momentum below 1e-12 m v, H - H~ below 1 % of K0, no contact missed, and two bodies
// that leave each other with most of their energy, deflected along y. With --events off it drifts by 4e-4 K0. With --offset 0 they meet head-on and rebound: equal bodies
// exchange their velocities, except for the part of the energy that stays behind as vibration.
#include "apps/two_cylinders.hpp"

int main(int argc, char** argv) { return abut::apps::run_slipping_cylinders(argc, argv); }
