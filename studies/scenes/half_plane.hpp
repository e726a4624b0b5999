#pragma once
#include "studies/scenes/boxes.hpp"
#include "studies/scenes/seismogram.hpp"

/// A line force on the surface of an elastic half plane (Lamb's problem), of the rock of plane_wave.hpp: P straight down
/// under a force across the surface, S straight down under one along it, and the Rayleigh wave on the surface.
namespace abut::studies {

/// Speed of the Rayleigh wave [m/s]: with xi = (c_R/c_S)^2 and k = (c_S/c_P)^2 the root in (0, 1) of
/// xi^3 - 8 xi^2 + (24 - 16 k) xi - 16 (1 - k) = 0.
[[nodiscard]] double rayleigh_speed(const solid::Material& material);

enum class LineForce { across, along };  ///< the surface

struct HalfPlaneOptions {
    LineForce force = LineForce::across;
    BoxCells cells = BoxCells::quadrangles;
    double per_wavelength = 20.0;  ///< edges of cells in a Rayleigh wavelength at the source's frequency
};

/// c_R over the frequency of the source [m]: the shortest wavelength.
[[nodiscard]] double rayleigh_wavelength();

/// The half x >= 0, y <= 0 of the medium, the rest follows by (anti)symmetry; the surface y = 0 has the force as a traction
/// ricker(t) exp(-(8 x / wavelength)^2). Nothing comes back from the far sides before the end of the run.
[[nodiscard]] run::Scene<2> half_plane(const HalfPlaneOptions& options);

/// Below the force at 4 and 7 Rayleigh wavelengths, displacement along the force.
[[nodiscard]] std::vector<Receiver<2>> receivers_below(LineForce force);
/// On the surface at 1, 2, ..., 8 Rayleigh wavelengths, displacement across it.
[[nodiscard]] std::vector<Receiver<2>> receivers_on_surface();

}  // namespace abut::studies
