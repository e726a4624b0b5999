#pragma once
#include <array>

#include "abut/run/scene.hpp"

namespace abut::studies {

/// Two discs in plane strain (2D) or cylinders with axes along z (3D) that fly towards each other along x, as in
/// scenes/slipping_cylinders.toml and scenes/slipping_cylinders_3d.toml: radius, length, E and rho of 1, nu of 0.3.
struct TwoCylinders {
    double size = 0.1;         ///< edge length of the cells [m]
    double speed = 0.05;       ///< of each body [m/s]
    double offset = 0.8;       ///< of the centres along y [m]
    double gap = 0.02;         ///< between the surfaces at the start [m]
    double refine = 1.0;       ///< how many times smaller cells are where the bodies meet first
    double refine_over = 0.5;  ///< distance over which cells grow to their own size from there [m]
};

/// Centres at the start, of the left one first [m]; the middle between them is the origin.
[[nodiscard]] std::array<Vector<2>, 2> centres(const TwoCylinders& options);

/// Scene with the modified reconstruction; its finding "restitution" is the speed of separation over that of approach
/// along the line of the two centres where they first touch [-].
template <int Dim>
[[nodiscard]] run::Scene<Dim> two_cylinders(const TwoCylinders& options);

}  // namespace abut::studies
