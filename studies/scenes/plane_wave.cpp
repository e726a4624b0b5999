#include "studies/scenes/plane_wave.hpp"

#include <cmath>
#include <numbers>

namespace abut::studies {
namespace {

using solid::Constraint;

constexpr double length = 9.0, first = 3.0, second = 6.0, periods = 10.0;  // in wavelengths, and periods of the source
constexpr double across = 3.0;                                             // in cells
constexpr double traction = 1e6;                                           // [Pa]

double wavelength(PlaneWave wave) { return wave_speed(wave, rock()) / source_frequency; }

double square(double x) { return x * x; }

/// About the energy that the traction puts in: power t^2/(rho c) for half a period.
double input_energy(PlaneWave wave, double area) {
    return area * square(traction) / (rock().density * wave_speed(wave, rock())) * 0.5 / source_frequency;
}

}  // namespace

std::string name_of(PlaneWave wave) { return wave == PlaneWave::compression ? "P" : "S"; }

solid::Material rock() { return {.young = 1.88e10, .poisson = 0.25, .density = 2200.0}; }

double wave_modulus(PlaneWave wave, const solid::Material& material) {
    return wave == PlaneWave::compression ? material.wave_modulus() : material.mu();
}

double wave_speed(PlaneWave wave, const solid::Material& material) {
    return std::sqrt(wave_modulus(wave, material) / material.density);
}

template <int Dim>
Vector<Dim> polarisation(PlaneWave wave) {
    return Vector<Dim>::Unit(wave == PlaneWave::compression ? 0 : 1);
}

template <int Dim>
std::vector<solid::DirichletCondition<Dim>> plane_wave_sides(PlaneWave wave) {
    std::vector<solid::DirichletCondition<Dim>> conditions;
    const auto sides = box_sides<Dim>();
    for (std::size_t i = 2; i < sides.size(); ++i) {
        const bool moved = wave == PlaneWave::shear && i < 4;  // ymin and ymax
        conditions.push_back({.group = sides[i], .constraint = moved ? Constraint::components : Constraint::normal});
        conditions.back().components[0] = moved;
        if (Dim == 3)
            conditions.back().components[2] = moved;  // else an edge could turn, and local equilibrium has to guess
    }
    return conditions;
}

double ChainDispersion::frequency(double theta) const {
    const double square_sum = modulus * square(std::sin(theta)) + 4.0 * eta * std::pow(std::sin(0.5 * theta), 6);
    return std::sqrt(square_sum / density) / size;
}

double ChainDispersion::speed(double omega, double dt) const {
    const double in_space = 2.0 / dt * std::sin(0.5 * omega * dt);  // the frequency of the same wave in a steady time
    double low = 0.0, high = 0.5 * std::numbers::pi;
    while (high - low > 1e-15) {
        const double middle = 0.5 * (low + high);
        if (middle == low || middle == high) break;
        (frequency(middle) < in_space ? low : high) = middle;
    }
    return omega * size / (0.5 * (low + high));
}

double cell_size(const PlaneWaveOptions& options) { return wavelength(options.wave) / options.per_wavelength; }

template <int Dim>
run::Scene<Dim> plane_wave(const PlaneWaveOptions& options) {
    const double size = cell_size(options);
    Vector<Dim> upper = Vector<Dim>::Constant(across * size);
    upper[0] = length * wavelength(options.wave);
    run::Scene<Dim> scene;
    scene.mesh = box_of<Dim>(options.cells, Vector<Dim>::Zero(), upper, size);
    scene.solid.materials = {rock()};
    scene.solid.boundary.dirichlet = plane_wave_sides<Dim>(options.wave);
    const Vector<Dim> direction = traction * polarisation<Dim>(options.wave);
    scene.solid.boundary.traction = {{.group = "xmin", .history = [direction](double t, const Vector<Dim>&) {
                                          return Vector<Dim>(ricker(t - source_delay, source_frequency) * direction);
                                      }}};
    scene.velocity = {Vector<Dim>::Zero()};
    scene.contact = false;
    scene.time = periods / source_frequency;
    scene.energy_scale = {"W0", input_energy(options.wave, std::pow(across * size, Dim - 1))};
    return scene;
}

template <int Dim>
std::vector<Receiver<Dim>> plane_wave_receivers(const PlaneWaveOptions& options) {
    std::vector<Receiver<Dim>> receivers;
    for (const double distance : {first, second}) {
        Vector<Dim> position = Vector<Dim>::Constant(0.5 * across * cell_size(options));
        position[0] = distance * wavelength(options.wave);
        receivers.push_back({position, polarisation<Dim>(options.wave)});
    }
    return receivers;
}

template Vector<2> polarisation<2>(PlaneWave);
template Vector<3> polarisation<3>(PlaneWave);
template std::vector<solid::DirichletCondition<2>> plane_wave_sides<2>(PlaneWave);
template std::vector<solid::DirichletCondition<3>> plane_wave_sides<3>(PlaneWave);
template run::Scene<2> plane_wave<2>(const PlaneWaveOptions&);
template run::Scene<3> plane_wave<3>(const PlaneWaveOptions&);
template std::vector<Receiver<2>> plane_wave_receivers<2>(const PlaneWaveOptions&);
template std::vector<Receiver<3>> plane_wave_receivers<3>(const PlaneWaveOptions&);

}  // namespace abut::studies
