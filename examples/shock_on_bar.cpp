// A shock in air runs into an elastic bar, and the bar into a second one: a fluid code drives the solid from outside.
//
// Air (gamma = 1.4, 1e5 Pa, 1.2 kg/m^3) behind a shock of Mach 2 hits a bar of rho = 50 kg/m^3 and c = 2000 m/s that cannot
// widen. Until a wave has run to its far end and back, 2L/c, its end gives way with v = (p - p0)/(rho c); the reflected shock
// of a wall with that speed (Rankine and Hugoniot) gives p(v), and the two meet at p = 1.451 MPa (1.5 MPa on a rigid wall).
// The far end then moves with 2v, closes a gap of 1 mm, and presses on the second bar with p - p0.
//
// The gas is one-dimensional: finite volumes, minmod slopes, HLLC, Heun's method, cells that move with the bar. The coupling:
// the bars keep their own step, and the gas chooses each of its own (solid::ClockedRun). MEMM knows where the faces of the bar
// will be before it knows the load, so the gas takes its step first, on a wall that moves so far, and hands its pressure on.
// Both book the same work: mass is exact and energy, too, except what the half-cell behind the loaded face stores, which goes
// as h. The pressure answers to the motion of its own step, which feeds the alternating mode of MEMM: neutral restarts take
// that out. With the argument `jumping` the gas takes random steps of 0.1 to 1 of the longest. To compare, with
// `without_restarts` there are none, and with `lagged` the bar feels the pressure of the step before (docs/loads.md).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes/shapes.hpp"
#include "abut/solid/body_motion.hpp"
#include "abut/solid/clocked_run.hpp"
#include "abut/solid/contact_view.hpp"
#include "abut/solid/solid.hpp"
#include "abut/solid/stepped_run.hpp"

using namespace abut;

namespace {

constexpr double ratio = 1.4, p_0 = 1e5, rho_0 = 1.2, mach = 2.0;          // of the gas at rest, and of the shock
constexpr double length = 0.5, gap = 1e-3, density = 50.0, poisson = 0.3;  // of both bars [m, kg/m^3]
constexpr double wave_speed = 2000.0, impedance = density * wave_speed;    // c, rho c of waves that cannot widen
constexpr int restart_period = 20;                                         // steps of the bars
constexpr double tube = 0.3, shock_at = -0.1;                              // of the gas: [-tube, 0] [m]

// Gas ----------------------------------------------------------------------------------------------------------------

struct State {
    double rho, u, p;
    [[nodiscard]] double sound() const { return std::sqrt(ratio * p / rho); }
    [[nodiscard]] double energy() const { return p / (ratio - 1.0) + 0.5 * rho * u * u; }  // per volume
};
using Flux = std::array<double, 3>;  // of mass, momentum and energy

/// Behind a shock that runs into gas at rest.
State behind_shock() {
    const double m2 = mach * mach, sound = std::sqrt(ratio * p_0 / rho_0);
    return {rho_0 * (ratio + 1.0) * m2 / ((ratio - 1.0) * m2 + 2.0), 2.0 * sound / (ratio + 1.0) * (mach - 1.0 / mach),
            p_0 * (1.0 + 2.0 * ratio / (ratio + 1.0) * (m2 - 1.0))};
}

/// The speed of a wall that reflects this gas with pressure p: a shock.
double wall_speed(const State& gas, double p) {
    return gas.u - (p - gas.p) * std::sqrt(2.0 / (gas.rho * ((ratio + 1.0) * p + (ratio - 1.0) * gas.p)));
}

/// Where it is that of the end of the bar, by bisection [Pa].
double coupled_pressure() {
    double low = behind_shock().p, high = 100.0 * p_0;
    while (high - low > 1e-6) {
        const double p = 0.5 * (low + high);
        (wall_speed(behind_shock(), p) > (p - p_0) / impedance ? low : high) = p;
    }
    return low;
}

/// Speed of the outer wave of one side, faster where it is a shock (Toro).
double outer_speed(const State& side, double p_star) {
    const double rise = std::max(0.0, p_star / side.p - 1.0);
    return side.sound() * std::sqrt(1.0 + 0.5 * (ratio + 1.0) / ratio * rise);
}

/// Across a face that moves with w.
Flux hllc(const State& left, const State& right, double w) {
    const double z = 0.25 * (left.rho + right.rho) * (left.sound() + right.sound());
    const double p_star = 0.5 * (left.p + right.p) - 0.5 * (right.u - left.u) * z;
    const double s_left = left.u - outer_speed(left, p_star), s_right = right.u + outer_speed(right, p_star);
    const double m_left = left.rho * (s_left - left.u), m_right = right.rho * (s_right - right.u);
    const double s = (right.p - left.p + m_left * left.u - m_right * right.u) / (m_left - m_right);
    const bool from_left = s >= w;
    const State& side = from_left ? left : right;
    const double s_side = from_left ? s_left : s_right, m = from_left ? m_left : m_right;
    if (from_left ? s_left >= w : s_right <= w)
        return {side.rho * (side.u - w), side.rho * side.u * (side.u - w) + side.p,
                side.energy() * (side.u - w) + side.p * side.u};
    const double rho = m / (s_side - s), p = side.p + m * (s - side.u);
    const double energy = ((s_side - side.u) * side.energy() - side.p * side.u + p * s) / (s_side - s);
    return {rho * (s - w), rho * s * (s - w) + p, energy * (s - w) + p * s};
}

double minmod(double a, double b) { return a * b <= 0.0 ? 0.0 : std::abs(a) < std::abs(b) ? a : b; }

/// A tube with a steady inflow at its left end and a wall that moves at its right one; all per area of it.
class Gas {
public:
    explicit Gas(int n) : content_(static_cast<std::size_t>(n)) {
        for (int i = 0; i < n; ++i) {
            const double behind = std::clamp((shock_at - face(i)) / width(), 0.0, 1.0);
            const State after = behind_shock(), ahead{rho_0, 0.0, p_0};
            const auto mean = [&](double a, double b) { return width() * (behind * a + (1.0 - behind) * b); };
            content_[i] = {mean(after.rho, ahead.rho), mean(after.rho * after.u, 0.0), mean(after.energy(), ahead.energy())};
        }
    }
    [[nodiscard]] double stable_step() const {
        double fastest = 0.0;
        for (std::size_t i = 0; i < content_.size(); ++i)
            fastest = std::max(fastest, std::abs(state(i).u) + state(i).sound());
        return 0.5 * width() / fastest;
    }
    /// The wall moves by `motion`. Returns the mean pressure on it.
    double step(double dt, double motion) {
        const std::vector<Flux> start = content_;
        const double p = add_fluxes(dt, motion / dt);
        wall_ += motion;
        const double mean = 0.5 * (p + add_fluxes(dt, motion / dt));
        for (std::size_t i = 0; i < content_.size(); ++i)
            for (int k = 0; k < 3; ++k) content_[i][k] = 0.5 * (start[i][k] + content_[i][k]);
        return mean;
    }
    /// What is in the tube less what has come in: 0 mass, 2 energy.
    [[nodiscard]] double closed_sum(int k) const {
        double sum = -inflow_[k];
        for (const Flux& cell : content_) sum += cell[k];
        return sum;
    }
    [[nodiscard]] double wall() const { return wall_; }

private:
    [[nodiscard]] double width() const { return (wall_ + tube) / static_cast<double>(content_.size()); }
    [[nodiscard]] double face(int i) const { return -tube + i * width(); }
    [[nodiscard]] State state(std::size_t i) const {
        const auto& [mass, momentum, energy] = content_[i];
        const double u = momentum / mass;
        return {mass / width(), u, (ratio - 1.0) * (energy - 0.5 * momentum * u) / width()};
    }
    /// Adds dt times the fluxes to all cells; the wall moves with `speed`. Returns the pressure on it.
    double add_fluxes(double dt, double speed) {
        const std::size_t n = content_.size();
        std::vector<State> left(n), right(n);    // at both ends of each cell
        const auto at = [&](std::ptrdiff_t i) {  // mirrored beyond the wall
            if (i < 0) return behind_shock();
            if (i < std::ssize(content_)) return state(static_cast<std::size_t>(i));
            const State last = state(n - 1);
            return State{last.rho, 2.0 * speed - last.u, last.p};
        };
        for (std::ptrdiff_t i = 0; i < std::ssize(content_); ++i) {
            const State before = at(i - 1), here = at(i), after = at(i + 1);
            const auto slope = [&](double State::*of) { return 0.5 * minmod(here.*of - before.*of, after.*of - here.*of); };
            const State half{slope(&State::rho), slope(&State::u), slope(&State::p)};
            left[i] = {here.rho - half.rho, here.u - half.u, here.p - half.p};
            right[i] = {here.rho + half.rho, here.u + half.u, here.p + half.p};
        }
        Flux in = hllc(behind_shock(), left[0], 0.0);
        for (int k = 0; k < 3; ++k) inflow_[k] += 0.5 * dt * in[k];  // of two stages
        for (std::size_t i = 0; i < n; ++i) {
            const double w = speed * static_cast<double>(i + 1) / static_cast<double>(n);
            const State beyond = i + 1 < n ? left[i + 1] : State{right[i].rho, 2.0 * speed - right[i].u, right[i].p};
            Flux out = hllc(right[i], beyond, w);
            if (i + 1 == n) out = {0.0, out[1], out[1] * speed};  // a wall: nothing passes, p does work
            for (int k = 0; k < 3; ++k) content_[i][k] += dt * (in[k] - out[k]);
            in = out;
        }
        return in[1];
    }

    std::vector<Flux> content_;  // mass, momentum and energy of each cell
    double wall_ = 0.0;
    Flux inflow_{};
};

// Bars ---------------------------------------------------------------------------------------------------------------

/// Two bars along x that cannot widen, n cells of length h in the first and two across; the second has other cells.
mesh::Mesh<2> two_bars(int n) {
    const double width = 2.0 * length / n, start = length + gap;
    return mesh::combine<2>(std::vector<mesh::Mesh<2>>{
        mesh::structured_box<2>({0.0, 0.0}, {length, width}, {n, 2}, mesh::CellShape::quadrangle, "bar"),
        mesh::structured_box<2>({start, 0.0}, {start + length, width}, {3 * n / 2, 3}, mesh::CellShape::quadrangle,
                                "second")});
}

solid::SolidOptions<2> options_of_bars() {
    const double wave_modulus = density * wave_speed * wave_speed;  // lambda + 2 mu
    const double young = wave_modulus * (1.0 + poisson) * (1.0 - 2.0 * poisson) / (1.0 - poisson);
    solid::SolidOptions<2> options;
    options.materials.assign(2, {.young = young, .poisson = poisson, .density = density});
    options.contact = contact::ContactOptions{};
    for (const char* side : {"bar.ymin", "bar.ymax", "second.ymin", "second.ymax"})
        options.boundary.dirichlet.push_back({.group = side, .constraint = solid::Constraint::normal});
    options.boundary.traction = {{.group = "bar.xmin", .from_outside = true}};
    return options;
}

// Both ---------------------------------------------------------------------------------------------------------------

struct Result {
    double pressure = 0.0;          // mean on the wall from 0.2 to 1.8 L/c after the shock has come [Pa]
    double pressure_error = 0.0;    // mean |p - reference| from 0 to 1.8 L/c, over p
    double contact_pressure = 0.0;  // on the second bar, from 0.2 to 1 L/c after they touch [Pa]
    double mass_defect = 0.0;       // largest, over all mass
    double energy_defect = 0.0;     // of the coupled energy, with what the half-cells store; over the work on the bar
    double stored = 0.0;            // what they store, over the same
    double drift = 0.0, excess = 0.0, parasitic = 0.0;  // of H~ less work, H - H~, both over the work; |e|/m over v
    double momentum_defect = 0.0;                       // of both bars less the impulse of the gas, over that
    std::int64_t steps = 0, gas_steps = 0, events = 0, missed = 0;
};

Result run(int n, const std::string& variant) {
    const mesh::Mesh<2> mesh = two_bars(n);
    auto made = std::make_unique<solid::Solid<2>>(mesh, options_of_bars());
    const std::vector<double> rest(made->size(), 0.0);
    const double step = 0.9 * dynamics::stable_step(*made).dt;  // of the bars, throughout
    solid::SteppedRun<2> coupled_bars(std::move(made), rest, rest, step,
                                      {.restart = variant == "without_restarts" ? 0 : restart_period});
    solid::Solid<2>& bars = coupled_bars.solid();
    auto& memm = coupled_bars.memm();
    solid::ClockedRun<2> clock(coupled_bars);
    dynamics::Ledger<2> ledger;
    ledger.record(dynamics::measure(memm, bars));
    Gas gas(static_cast<int>(std::lround(4.0 * n * tube / length)));  // cells of h/4, which choose their own steps
    const double mass = gas.closed_sum(0), energy = gas.closed_sum(2), width = 2.0 * length / n;
    std::mt19937 random(7);

    const double p = coupled_pressure(), v = (p - p_0) / impedance, transit = length / wave_speed;
    const double arrival = -shock_at / (mach * std::sqrt(ratio * p_0 / rho_0)), touch = arrival + transit + gap / (2.0 * v);
    Result result;
    double last = p_0;  // the pressure of the step before
    double impulse = 0.0, weight = 0.0, early = 0.0, late = 0.0, early_time = 0.0, defect = 0.0;
    while (clock.time() < arrival + 2.8 * transit) {
        double chosen = gas.stable_step();
        if (variant == "jumping") chosen *= 0.1 + 0.9 * static_cast<double>(random()) / std::mt19937::max();
        const double dt = std::min(chosen, clock.time_to_node());
        const auto motion = clock.motion("bar.xmin", dt);
        double on_wall = gas.step(dt, 0.5 * (motion[0].x() + motion[1].x()));
        if (variant == "lagged") std::swap(on_wall, last);
        clock.set_traction("bar.xmin",
                           std::vector<Vector<2>>(2, Vector<2>(on_wall - p_0, 0.0)));  // p_0 acts behind the bars
        const double middle = (clock.time() + 0.5 * dt - arrival) / transit;           // [L/c]
        const std::int64_t steps = memm.steps();
        clock.advance(dt);
        ++result.gas_steps;

        if (middle > 0.2 && middle < 1.8) result.pressure += dt * on_wall, weight += dt;
        if (middle < 1.8) result.pressure_error += dt * std::abs(on_wall - (middle > 0.0 ? p : p_0)) / (1.8 * transit * p);
        impulse += dt * (on_wall - p_0) * width;
        if (memm.steps() == steps) continue;  // inside a step of the bars
        const auto bodies = solid::body_motions<2>(memm, bars);
        const double of_second = bodies[1].mass * bodies[1].velocity.x();
        if (memm.time() < touch + 0.2 * transit) early = of_second, early_time = memm.time();
        if (memm.time() < touch + transit) late = (of_second - early) / (memm.time() - early_time) / width;
        result.momentum_defect = std::abs(bodies[0].mass * bodies[0].velocity.x() + of_second - impulse) / impulse;
        if (memm.steps() % 10 != 9) continue;  // in the middle between two restarts, and before each
        ledger.record(dynamics::measure(memm, bars));
        const solid::OutsideWork work = bars.outside_work(memm.q());
        const double of_bars = ledger.entries().back().pseudo_energy + work.held;  // without the load
        const double coupled = width * (gas.closed_sum(2) - energy + p_0 * gas.wall()) + of_bars;
        defect = std::max(defect, std::abs(coupled - work.changes));
        result.mass_defect = std::max(result.mass_defect, std::abs(gas.closed_sum(0) - mass) / mass);
        result.parasitic = std::max(result.parasitic, ledger.entries().back().parasitic / v);
    }
    const solid::OutsideWork work = bars.outside_work(memm.q());
    result.pressure /= weight;
    result.contact_pressure = late;
    result.energy_defect = defect / work.steps;
    result.stored = work.changes / work.steps;
    result.drift = ledger.pseudo_energy_drift() / work.steps;
    result.excess = ledger.energy_excess() / work.steps;
    result.steps = memm.steps();
    result.events = bars.contact().report().events;
    result.missed = bars.contact().report().missed_contacts;
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string variant = argc > 1 ? argv[1] : "";
    if (!variant.empty() && variant != "jumping" && variant != "without_restarts" && variant != "lagged") {
        std::fprintf(stderr, "shock_on_bar: '%s' is not known; there are jumping, without_restarts, lagged\n",
                     variant.c_str());
        return 2;
    }
    const double p = coupled_pressure();
    std::printf("p of the reflected shock: %.4f MPa on the bar, which gives way with %.3f m/s\n\n", 1e-6 * p,
                (p - p_0) / impedance);
    std::printf(
        "  h/L     p/p_ref-1  mean |p-p_ref|  contact   mass     energy   stored   H~-work  H-H~     |e|/m v  momentum "
        "steps of gas events missed\n");
    bool good = true;
    double coarser = 0.0;
    for (const int n : {40, 80, 160}) {
        const Result r = run(n, variant);
        const double error = r.pressure / p - 1.0, contact = r.contact_pressure / (p - p_0) - 1.0;
        std::printf("  1/%-4d  %+.1e   %.1e         %+.1e  %.1e  %.1e  %.1e  %.1e  %.1e  %.1e  %.1e  %lld %lld %lld %lld\n",
                    n, error, r.pressure_error, contact, r.mass_defect, r.energy_defect, r.stored, r.drift, r.excess,
                    r.parasitic, r.momentum_defect, static_cast<long long>(r.steps), static_cast<long long>(r.gas_steps),
                    static_cast<long long>(r.events), static_cast<long long>(r.missed));
        good = good && std::abs(error) < 5e-3 && std::abs(contact) < 0.02 && r.missed == 0;
        good = good && r.mass_defect < 1e-12 && r.energy_defect < 1e-11 && r.momentum_defect < 1e-11;
        if (coarser > 0.0) good = good && r.pressure_error < 0.6 * coarser;  // order 1: the shock is spread over some cells
        coarser = r.pressure_error;
    }
    return good ? 0 : 1;
}
