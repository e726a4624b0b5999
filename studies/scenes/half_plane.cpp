#include "studies/scenes/half_plane.hpp"

#include <cmath>

#include "studies/scenes/plane_wave.hpp"

namespace abut::studies {
namespace {

// In Rayleigh wavelengths, and periods of the source. In that time P runs 1.88 x 10.5 = 19.8 wavelengths: from the force to
// a far side and on to a receiver at 7 it is 20 (x) and 21 (y) of them.
constexpr double width = 13.5, depth = 10.0, run_periods = 10.5;
constexpr double below_first = 4.0, below_second = 7.0;
constexpr int on_surface = 8;
constexpr double narrowness = 8.0;        // wavelengths over the half width of the force
constexpr double largest_traction = 1e6;  // [Pa]

double squared(double x) { return x * x; }

/// About the energy that the force puts in: power t^2/(rho c) for half a period.
double input_energy() {
    const double area = 0.6 * rayleigh_wavelength() / narrowness;  // integral of exp(-2 (8 x / wavelength)^2)
    return area * squared(largest_traction) / (rock().density * wave_speed(PlaneWave::shear, rock())) * 0.5 /
           source_frequency;
}

solid::Field<2> source(const Vector<2>& force) {
    return [force, scale = narrowness / rayleigh_wavelength()](double t, const Vector<2>& x) {
        return Vector<2>(ricker(t - source_delay, source_frequency) * std::exp(-squared(scale * x[0])) * force);
    };
}

}  // namespace

double rayleigh_speed(const solid::Material& material) {
    const double s = wave_speed(PlaneWave::shear, material);
    const double k = squared(s / wave_speed(PlaneWave::compression, material));
    double low = 0.0, high = 1.0;  // negative at 0, 1 at 1, one root between for every nu
    for (int i = 0; i < 60; ++i) {
        const double xi = 0.5 * (low + high);
        (((xi - 8.0) * xi + 24.0 - 16.0 * k) * xi - 16.0 * (1.0 - k) < 0.0 ? low : high) = xi;
    }
    return s * std::sqrt(0.5 * (low + high));
}

double rayleigh_wavelength() { return rayleigh_speed(rock()) / source_frequency; }

run::Scene<2> half_plane(const HalfPlaneOptions& options) {
    const double wavelength = rayleigh_wavelength();
    const bool across = options.force == LineForce::across;
    run::Scene<2> scene;
    scene.mesh = box_of<2>(options.cells, Vector<2>(0.0, -depth * wavelength), Vector<2>(width * wavelength, 0.0),
                           wavelength / options.per_wavelength);
    scene.solid.materials = {rock()};
    scene.solid.boundary.dirichlet = {
        {.group = "xmin", .constraint = solid::Constraint::components, .components = {across, !across}}};
    const Vector<2> force = largest_traction * (across ? Vector<2>(0.0, -1.0) : Vector<2>(1.0, 0.0));
    scene.solid.boundary.traction = {{.group = "ymax", .history = source(force)}};
    scene.velocity = {Vector<2>::Zero()};
    scene.contact = false;
    scene.time = run_periods / source_frequency;
    scene.energy_scale = {"W0", input_energy()};
    return scene;
}

std::vector<Receiver<2>> receivers_below(LineForce force) {
    const Vector<2> direction = Vector<2>::Unit(force == LineForce::across ? 1 : 0);
    return {{Vector<2>(0.0, -below_first * rayleigh_wavelength()), direction},
            {Vector<2>(0.0, -below_second * rayleigh_wavelength()), direction}};
}

std::vector<Receiver<2>> receivers_on_surface() {
    std::vector<Receiver<2>> receivers;
    for (int i = 1; i <= on_surface; ++i)
        receivers.push_back({Vector<2>(i * rayleigh_wavelength(), 0.0), Vector<2>::UnitY()});
    return receivers;
}

}  // namespace abut::studies
