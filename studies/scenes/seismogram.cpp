#include "studies/scenes/seismogram.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace abut::studies {
namespace {

using std::numbers::pi;

/// Share of a value at time t in a window.
double share(double t, double from, double to, double taper) {
    const double outside = std::max({0.0, from - t, t - to});
    if (outside >= taper) return outside > 0.0 ? 0.0 : 1.0;
    return 0.5 * (1.0 + std::cos(pi * outside / taper));
}

/// sum_n a_n b_{n+lag}
double correlation(const Trace& a, const Trace& b, std::ptrdiff_t lag) {
    const auto n_a = static_cast<std::ptrdiff_t>(a.values.size()), n_b = static_cast<std::ptrdiff_t>(b.values.size());
    double sum = 0.0;
    for (std::ptrdiff_t n = std::max<std::ptrdiff_t>(0, -lag); n < std::min(n_a, n_b - lag); ++n)
        sum += a.values[static_cast<std::size_t>(n)] * b.values[static_cast<std::size_t>(n + lag)];
    return sum;
}

std::complex<double> amplitude_of(const Trace& trace, double frequency) {
    std::complex<double> sum = 0.0;
    for (std::size_t n = 0; n < trace.values.size(); ++n)
        sum += trace.values[n] * std::polar(1.0, -2.0 * pi * frequency * trace.dt * static_cast<double>(n));
    return sum;
}

}  // namespace

Trace windowed(const Trace& trace, double from, double to, double taper) {
    Trace result = trace;
    for (std::size_t n = 0; n < trace.values.size(); ++n)
        result.values[n] *= share(trace.dt * static_cast<double>(n), from, to, taper);
    return result;
}

double correlation_delay(const Trace& a, const Trace& b) {
    const auto size = static_cast<std::ptrdiff_t>(b.values.size());
    std::ptrdiff_t best = 0;
    double largest = -std::numeric_limits<double>::infinity();
    for (std::ptrdiff_t lag = 0; lag < size; ++lag)
        if (const double value = correlation(a, b, lag); value > largest) {
            largest = value;
            best = lag;
        }
    const double before = correlation(a, b, best - 1), after = correlation(a, b, best + 1);
    const double curvature = before - 2.0 * largest + after;
    const double shift = curvature < 0.0 ? 0.5 * (before - after) / curvature : 0.0;
    return a.dt * (static_cast<double>(best) + shift);
}

double phase_delay(const Trace& a, const Trace& b, double frequency, double expected) {
    const double period = 1.0 / frequency;
    const double lag = std::arg(amplitude_of(a, frequency) / amplitude_of(b, frequency)) / (2.0 * pi) * period;
    return lag + period * std::round((expected - lag) / period);
}

double ricker(double t, double frequency) {
    const double s = pi * pi * frequency * frequency * t * t;
    return (1.0 - 2.0 * s) * std::exp(-s);
}

template <int Dim>
void Seismograph<Dim>::begin(const run::Scene<Dim>& scene, const run::RunResult<Dim>& result) {
    const auto& centres = scene.mesh.cell_centroid;
    for (const Receiver<Dim>& receiver : receivers_) {
        const auto nearer = [&](const Vector<Dim>& a, const Vector<Dim>& b) {
            return (a - receiver.position).squaredNorm() < (b - receiver.position).squaredNorm();
        };
        const auto nearest = std::min_element(centres.begin(), centres.end(), nearer);
        cells_.push_back(static_cast<std::size_t>(nearest - centres.begin()));
        positions_.push_back(*nearest);
        traces_.push_back({.dt = result.run.dt, .values = {}});
    }
}

template <int Dim>
void Seismograph<Dim>::look(const dynamics::RunView<Dim>& run, solid::Solid<Dim>&) {
    const auto u = as_vectors<Dim>(run.q);
    for (std::size_t i = 0; i < receivers_.size(); ++i)
        traces_[i].values.push_back(u[cells_[i]].dot(receivers_[i].direction));
}

template class Seismograph<2>;
template class Seismograph<3>;

}  // namespace abut::studies
