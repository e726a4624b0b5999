// An elastic bar bounces on a rigid wall, again and again: what an energy that is conserved does not tell.
//
// Length 10, E = 900, rho = 1, nu = 0, so c = 30; gravity 10 towards the wall, from rest 5 above it. It hits at t = 1 with
// speed 10; a pressure wave takes 2L/c to run up and down, pressure 300 rising to 500: impulse 266.667 an impact.
// H~ stays exact whatever happens, but each contact event kicks the undamped alternating mode of MEMM: watch |e| and
// H - H~ over a million steps (--steps 1000000) with and without the energy-neutral filter. docs/filter.md has the table.
#include <fmt/core.h>
#include <fmt/os.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "abut/contact/obstacle.hpp"
#include "abut/dynamics/ledger.hpp"
#include "abut/dynamics/parasitic_filter.hpp"
#include "abut/dynamics/stable_step.hpp"
#include "abut/mesh/shapes.hpp"

namespace {

using namespace abut;

constexpr double bar_length = 10.0, young = 900.0, density = 1.0, gravity = 10.0, height = 5.0;  // SI
const double wave_speed = std::sqrt(young / density);
const double crossing = bar_length / wave_speed;                                     // L/c [s]
const double impact_speed = std::sqrt(2.0 * gravity * height);
const double exact_impulse = 2.0 * density * bar_length * (impact_speed + gravity * crossing);  // an impact, per area of the bar

struct Choices {
    int cells = 100;
    double cfl = 0.5;
    double eta = 1.0;
    std::int64_t steps = 10'000;
    std::string filter = "neutral";
    std::string weights = "stiffness";
    std::int64_t interval = 100;
    std::string csv = "energy.csv";
};

Choices read_choices(int argc, char** argv) {
    Choices choices;
    CLI::App app{"Bar bouncing on a rigid wall under gravity: pseudo-energy, energy and parasitic mode."};
    app.option_defaults()->always_capture_default();
    app.add_option("--cells", choices.cells, "cells along the bar; two across it [-]")->check(CLI::Range(4, 100'000));
    app.add_option("--cfl", choices.cfl, "time step in units of h/c [-]")->check(CLI::Range(1e-6, 1.0));
    app.add_option("--eta", choices.eta, "stabilisation of jumps between cells in units of E [-]")->check(CLI::Range(1e-3, 10.0));
    app.add_option("--steps", choices.steps, "time steps [-]")->check(CLI::PositiveNumber);
    app.add_option("--filter", choices.filter, "of the alternating mode, after each step in contact")->check(CLI::IsMember({"none", "neutral"}));
    app.add_option("--weights", choices.weights, "share of a correction; of no effect against a rigid wall")
        ->check(CLI::IsMember({"half", "stiffness"}));
    app.add_option("--interval", choices.interval, "steps between two rows of the energy file [-]")->check(CLI::PositiveNumber);
    app.add_option("--csv", choices.csv, "the energy file");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::exit(app.exit(error));
    }
    return choices;
}

double cell_size(const Choices& choices) { return bar_length / choices.cells; }
double width(const Choices& choices) { return 2.0 * cell_size(choices); }

/// A strip of squares, two across.
mesh::Mesh<2> bar(const Choices& choices) {
    const double half = 0.5 * width(choices);
    return mesh::structured_box<2>({-half, height}, {half, height + bar_length}, {2, choices.cells}, mesh::CellShape::quadrangle, "bar");
}

dynamics::SolidOptions<2> scene(const Choices& choices) {
    dynamics::SolidOptions<2> options;
    options.materials = {{.young = young, .poisson = 0.0, .density = density, .eta = choices.eta * young}};
    options.acceleration = {Vector<2>(0.0, -gravity)};
    for (const char* side : {"xmin", "xmax"})  // rollers: with nu = 0 they carry nothing, and the bar stays upright for ever
        options.boundary.dirichlet.emplace_back(dynamics::DirichletCondition<2>{side, dynamics::Constraint::normal, {}, {0.0, 0.0}, {}});
    options.contact.emplace();
    options.contact->weights = choices.weights == "half" ? contact::Weights::half : contact::Weights::stiffness;
    options.contact->compression_limit = 1e3;  // an impact at a third of the wave speed: the foot gives way by more than its cell
    options.contact->skin = 0.1 * bar_length;  // only the foot of the bar faces the wall: a thick skin costs nothing and lasts long
    options.obstacles = {contact::plane_obstacle<2>(Vector<2>::Zero(), Vector<2>::UnitY(), bar_length)};
    return options;
}

/// Impulses of the wall, one an impact: contacts less than a wave's way through the bar apart belong together.
class Impacts {
public:
    void add(double impulse, double dt) {
        if (impulse == 0.0) {
            quiet_ += dt;
            return;
        }
        if (finished()) impulses_.push_back(0.0);
        impulses_.back() += impulse;
        quiet_ = 0.0;
    }
    /// Those that are over.
    [[nodiscard]] std::vector<double> complete() const {
        std::vector<double> result = impulses_;
        if (!finished() && !result.empty()) result.pop_back();
        return result;
    }

private:
    [[nodiscard]] bool finished() const { return impulses_.empty() || quiet_ > crossing; }
    std::vector<double> impulses_;
    double quiet_ = 0.0;  // since the last contact [s]
};

struct Run {
    dynamics::Ledger<2> ledger;
    Impacts impacts;
    contact::ContactReport contact;
    dynamics::SolidTimes times;
    std::int64_t steps = 0;
    std::string stopped;     ///< why a run ended early: it exploded
    double seconds = 0.0;
    double dt = 0.0;
    double stable_dt = 0.0;  ///< 2 / omega_max of the free bar
};

/// The stable step of the free bar; closed contact is left without a margin here: a Courant number of 0.9 is to be shown.
double free_stable_dt(dynamics::Solid<2>& solid, const Choices& choices, double dt) {
    const double limit = 2.0 / dynamics::stable_step(solid).omega_max;
    if (dt > limit)
        throw std::invalid_argument(fmt::format("--cfl {}: the time step is {:.6g} s, at most {:.6g} s is stable. Take --cfl {:.3f} or less.",
                                                choices.cfl, dt, limit, std::floor(1000.0 * choices.cfl * limit / dt) / 1000.0));
    return limit;
}

Run bounce(const Choices& choices) {
    const auto mesh = bar(choices);
    dynamics::Solid<2> solid(mesh, scene(choices));
    Run run;
    run.dt = choices.cfl * cell_size(choices) / wave_speed;
    run.stable_dt = free_stable_dt(solid, choices, run.dt);
    const std::vector<double> at_rest(solid.size(), 0.0);
    dynamics::Memm<dynamics::Solid<2>> integrator(solid, at_rest, at_rest, run.dt);
    dynamics::NeutralFilter<2> filter(solid);
    if (choices.filter == "neutral")
        integrator.set_after_step([&](auto q, double dt, auto before, auto after) { filter(q, dt, before, after); });

    const auto start = std::chrono::steady_clock::now();
    run.ledger.record(measure(integrator, solid));
    try {
        while (run.steps < choices.steps) {
            integrator.step();
            ++run.steps;
            run.impacts.add(-solid.obstacle_force(0)[1] * run.dt / width(choices), run.dt);
            if (run.steps % choices.interval == 0 || run.steps == choices.steps) run.ledger.record(measure(integrator, solid));
        }
    } catch (const std::runtime_error& error) {
        run.stopped = error.what();
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    run.contact = solid.contact_report();
    run.times = solid.times();
    return run;
}

void write_csv(const Run& run, const std::string& path) {
    auto file = fmt::output_file(path);
    file.print("{}\n", fmt::join(dynamics::ledger_columns<2>(), ","));
    for (const auto& entry : run.ledger.entries()) {
        const auto values = dynamics::ledger_values(entry);
        for (std::size_t i = 0; i < values.size(); ++i) file.print("{}{:.17g}", i == 0 ? "" : ",", values[i]);
        file.print("\n");
    }
}

void print(const Choices& choices, const Run& run) {
    const double mass = density * bar_length * width(choices);
    const double energy_0 = mass * gravity * height;  // H0: of the fall, all kinetic at the first impact
    const double largest = energy_0 + std::max(0.0, run.ledger.largest_energy());
    const auto steps = static_cast<double>(run.steps);
    const auto impulses = run.impacts.complete();
    const double first = impulses.empty() ? std::numeric_limits<double>::quiet_NaN() : impulses.front();
    fmt::print("bar of {} x 2 cells, dt = {:.6g} s ({:.3f} h/c, {:.3f} of the free stable step), H0 = {:.6g} J\n", choices.cells, run.dt,
               choices.cfl, run.dt / run.stable_dt, energy_0);
    fmt::print("{:>8} {:>8} {:>7} {:>9} {:>11} {:>11} {:>13} {:>9} {:>9} {:>9} {:>8} {:>7} {:>5}\n", "steps", "filter", "bounces", "max|e|/m",
               "(H-H~)/H0", "drift/H0", "drift/largest", "events", "impulse 1", "exact", "seconds", "max g/D", "lost");
    fmt::print("{:>8} {:>8} {:>7} {:>9.3g} {:>11.3g} {:>11.2e} {:>13.2e} {:>9} {:>9.3f} {:>9.3f} {:>8.1f} {:>7.2f} {:>5}\n", run.steps,
               choices.filter, impulses.size(), run.ledger.parasitic(), run.ledger.energy_excess() / energy_0,
               run.ledger.pseudo_energy_drift() / energy_0, run.ledger.pseudo_energy_drift() / largest, run.contact.events, first, exact_impulse, run.seconds,
               run.contact.compression_max, run.contact.lost_contacts);
    fmt::print("time a step: {:.2f} us (bulk {:.2f}, contact {:.2f}, search {:.2f})\n", 1e6 * run.seconds / steps,
               1e6 * run.times.bulk / steps, 1e6 * run.times.contact / steps,
               1e6 * run.times.search / steps);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Choices choices = read_choices(argc, argv);
        const Run run = bounce(choices);
        write_csv(run, choices.csv);
        print(choices, run);
        if (run.stopped.empty()) return 0;
        fmt::print(stderr, "bouncing_bar: stopped after step {}: {}\n", run.steps, run.stopped);
        return 1;
    } catch (const std::exception& error) {
        fmt::print(stderr, "bouncing_bar: {}\n", error.what());
        return 1;
    }
}
