#pragma once
#include "studies/scenes/boxes.hpp"
#include "studies/scenes/seismogram.hpp"

/// Plane waves along the first axis: what a strip or bar cannot tell from an unbounded medium, and how fast they are.
namespace abut::studies {

enum class PlaneWave { compression, shear };
[[nodiscard]] std::string name_of(PlaneWave wave);  ///< "P", "S"

/// E = 1.88e10, nu = 0.25, rho = 2200: a rock with speeds of 3202.3 and 1848.8 m/s.
[[nodiscard]] solid::Material rock();

/// lambda + 2 mu or mu [Pa]
[[nodiscard]] double wave_modulus(PlaneWave wave, const solid::Material& material);
[[nodiscard]] double wave_speed(PlaneWave wave, const solid::Material& material);  ///< [m/s]

/// Direction of the displacement: x of compression, y of shear.
template <int Dim>
[[nodiscard]] Vector<Dim> polarisation(PlaneWave wave);

/// Conditions that hold the sides of a strip or bar along x so that the wave runs as in an unbounded medium: rollers,
/// and of a wave of shear no displacement along the sides that it moves.
template <int Dim>
[[nodiscard]] std::vector<solid::DirichletCondition<Dim>> plane_wave_sides(PlaneWave wave);

/// The scheme on equal squares or cubes, where a plane wave along an axis is that of a chain:
///     rho h^2 omega^2 = M sin^2 theta + 4 eta sin^6(theta/2), theta = k h      in space
///     sin(omega_dt dt / 2) = omega dt / 2                                      in time (MEMM, linear forces)
struct ChainDispersion {
    double modulus;  ///< M [Pa]
    double eta;      ///< [Pa]
    double density;  ///< [kg/m^3]
    double size;     ///< h [m]

    /// omega [rad/s]; of a steady time.
    [[nodiscard]] double frequency(double theta) const;
    /// Phase speed [m/s] of the wave that the scheme has at a frequency [rad/s] below that of theta = pi/2.
    [[nodiscard]] double speed(double omega, double dt) const;
};

struct PlaneWaveOptions {
    PlaneWave wave = PlaneWave::compression;
    BoxCells cells = BoxCells::quadrangles;
    double per_wavelength = 20.0;  ///< edges of cells in a wavelength at the source's frequency
};

inline constexpr double source_frequency = 10.0;                ///< [Hz], where the spectrum of the source is largest
inline constexpr double source_delay = 1.5 / source_frequency;  ///< [s], of the middle of the source

/// [m], of the cells: the wave length at the source's frequency over the cells in it.
[[nodiscard]] double cell_size(const PlaneWaveOptions& options);

/// A strip or bar, 9 wavelengths long and 3 cells across, with a Ricker wavelet as the traction of its end x = 0; the other
/// end is so far away that nothing comes back to `plane_wave_receivers` in time.
template <int Dim>
[[nodiscard]] run::Scene<Dim> plane_wave(const PlaneWaveOptions& options);

/// At 3 and 6 wavelengths.
template <int Dim>
[[nodiscard]] std::vector<Receiver<Dim>> plane_wave_receivers(const PlaneWaveOptions& options);

}  // namespace abut::studies
