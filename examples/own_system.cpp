// A system of one's own under every scheme of abut::dynamics: the Duffing oscillator m q'' = -k q - b q^3.
//
// From rest at A, V = k/2 q^2 + b/4 q^4, with m = k = b = 1 and A = 2: a strong nonlinearity. The period is
// 4 K(M) / sqrt((k + b A^2)/m) with M = b A^2 / (2 (k + b A^2)), K the complete elliptic integral of the first kind. At 200
// steps in a period each scheme finds it to 1e-3; all but leapfrog keep their own energy to round-off.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <vector>

#include "abut/dynamics/bilbao.hpp"
#include "abut/dynamics/composed.hpp"
#include "abut/dynamics/energy_momentum.hpp"
#include "abut/dynamics/leapfrog.hpp"
#include "abut/dynamics/memm.hpp"
#include "abut/dynamics/memm_async.hpp"

using namespace abut;

namespace {

constexpr double k = 1.0, b = 1.0, amplitude = 2.0;  // [N/m], [N/m^3], [m]; m = 1 kg

/// What the schemes ask of a system. The first four are enough for leapfrog and Bilbao's scheme.
class Duffing {
public:
    [[nodiscard]] std::size_t size() const { return 1; }
    [[nodiscard]] std::span<const double> inverse_mass() const { return inverse_mass_; }
    void force(std::span<const double> q, std::span<double> f) { f[0] = -(k + b * q[0] * q[0]) * q[0]; }
    [[nodiscard]] double potential(std::span<const double> q) const {
        return (0.5 * k + 0.25 * b * q[0] * q[0]) * q[0] * q[0];
    }
    /// Mean of the force on the straight line from q_0 to q_1, exact: what makes MEMM conserve its energy.
    void mean_force(std::span<const double> q_0, std::span<const double> q_1, double, double, std::span<double> f) {
        f[0] = mean(q_0[0], q_1[0]);
    }
    /// The mean is the integral, which compositions of order 4 and 6 ask for.
    [[nodiscard]] static bool mean_is_exact() { return true; }
    /// d^2V/dq^2, for the implicit scheme.
    void append_stiffness(std::span<const double> q, double factor, std::vector<dynamics::MatrixEntry>& entries) const {
        entries.push_back({0, 0, factor * (k + 3.0 * b * q[0] * q[0])});
    }
    /// For local steps: all there is belongs to one level.
    void set_levels(std::int32_t, std::span<const std::int32_t>) {}
    void add_impulse(std::int32_t, const dynamics::FreeFlight& flight, double, double dt, std::span<double> impulse) {
        impulse[0] += dt * mean(flight.at(0, 0.0), flight.at(0, dt));
    }

private:
    static double mean(double x, double y) { return -0.5 * (x + y) * (k + 0.5 * b * (x * x + y * y)); }
    std::vector<double> inverse_mass_{1.0};
};

const double modulus = b * amplitude * amplitude / (2.0 * (k + b * amplitude * amplitude));
const double period = 4.0 * std::comp_ellint_1(std::sqrt(modulus)) / std::sqrt(k + b * amplitude * amplitude);  // [s]
const double dt = period / 200.0;

/// Ten periods: the length of one from the times at which q sinks through 0, and what happened to the energies.
template <class Integrator>
bool run(const char* name, Integrator integrator, double allowed_drift) {
    std::vector<double> falls;
    const double own = integrator.pseudo_energy(), start = integrator.energy();
    double drift = 0.0, error = 0.0;
    while (integrator.time() < 10.0 * period) {
        const double before = integrator.q()[0], time = integrator.time();
        integrator.step();
        const double after = integrator.q()[0];
        if (before > 0.0 && after <= 0.0) falls.push_back(time + dt * before / (before - after));
        drift = std::max(drift, std::abs(integrator.pseudo_energy() - own) / start);
        error = std::max(error, std::abs(integrator.energy() - start) / start);
    }
    const double found = (falls.back() - falls.front()) / static_cast<double>(falls.size() - 1);
    std::printf("%-16s period %.6f s, exact %.6f; own energy drifts by %.1e, H is off by %.1e\n", name, found, period, drift,
                error);
    return std::abs(found - period) < 1e-3 * period && drift < allowed_drift;
}

}  // namespace

int main() {
    using namespace abut::dynamics;
    Duffing system;
    const std::vector<double> q{amplitude}, p{0.0};
    bool good = run("memm", Memm<Duffing>(system, q, p, dt), 1e-13);
    good = run("memm_async", MemmAsync<Duffing>(system, q, p, dt, {.parts = {1}, .level = {0}}), 1e-13) && good;
    good = run("blanes_moan_4", Composed<Duffing>(system, q, p, dt, Composition::blanes_moan_4), 1e-13) && good;
    good = run("leapfrog", Leapfrog<Duffing>(system, q, p, dt), 1e-2) && good;
    good = run("bilbao", Bilbao<Duffing>(system, q, p, dt, 1.0), 1e-13) && good;
    good = run("energy_momentum", EnergyMomentum<Duffing>(system, q, p, dt), 1e-13) && good;
    return good ? 0 : 1;
}
