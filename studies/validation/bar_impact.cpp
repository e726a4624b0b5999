// An elastic bar flies into a rigid wall and rebounds: pressure, time and speed of an impact against their closed forms.
//
// L = 10, E = 900, rho = 1, nu = 0, so c = 30; at 10 towards a wall 5 away, without gravity. A compression wave runs up the
// bar and comes back as a release wave: contact from 0.5 to 0.5 + 2L/c = 1.16667 at the pressure v0 sqrt(E rho) = 300, and
// the bar flies back at 10, undeformed. In the cells short waves are slower than long ones: the fronts spread, the release
// is late and a part of the speed stays behind as vibration, both like h^(2/3) and by as much as dispersed_impact says.
// Strips disperse as a chain of half as many cells does; the pressure of the chain oscillates about the exact one all the
// time.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/support/choices.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/bars.hpp"

namespace abut::studies::bar_impact_study {
namespace {

constexpr double end = 1.75;      // of the run [s]
constexpr int least_cells = 100;  // from which on the targets hold that do not scale with h

const apps::Program program{
    .name = "bar_impact",
    .purpose = "Bar that hits a rigid wall once: pressure, release and rebound against closed forms.",
    .footer = "The bar: L = 10 m, E = 900 Pa, rho = 1 kg/m^3, nu = 0; it hits the wall, 5 m away, at 10 m/s."};

BarOnWall scene() {
    const Bar bar;
    return {.bar = bar,
            .gap = ExactBounce::height,
            .speed = ExactBounce::speed,
            .energy = 0.5 * bar.mass() * ExactBounce::speed * ExactBounce::speed,
            .time = end};
}

Level level(const BarRun& run, const BarOptions& options, int cells) {
    const Bar bar;
    const ExactBounce exact(0.0);
    const double h = bar.length / cells, release = exact.hit() + bar.contact_time();
    const auto from_least = [&](double allowed) { return cells >= least_cells ? allowed : no_target; };
    Level level{.name = fmt::format("{}, {} cells", options.body_name(), cells), .size = h, .energies = run.energies};
    level.seconds = run.seconds;
    const auto found = impacts(run.history, 0.5 * bar.contact_time());
    if (found.empty()) throw std::runtime_error(level.name + ": the bar is still in contact at the end of the run.");
    const Impact& impact = found.front();
    const DispersedImpact dispersed = dispersed_impact(bar, options.body, cells, options.cfl);
    const MiddlePressure pressure =
        middle_pressure(run.history, exact.hit(), bar.contact_time(), [&](double) { return exact.pressure(0.0); });
    level.quantities = {
        {"contact from", "s", impact.begin, exact.hit(), 0.0, 1e-9},
        {"pressure, mean", "Pa", pressure.mean, exact.pressure(0.0), 0.0, from_least(2e-3)},
        {"pressure - exact, rms", "Pa", pressure.rms, 0.0, exact.pressure(0.0)},
        {"released at", "s", impact.end, release, 0.0, 1.5 * h / bar.wave_speed() / release},
        {"rebound of the centre of mass", "m/s", impact.speed[0], exact.speed, 0.0, from_least(0.015)},
        {"impulse", "N s/m^2", impact.impulse, exact.impulse()},
        {"delay of release / that of dispersion", "", (impact.end - release) / dispersed.delay, 1.0},
        {"loss of speed / that of dispersion", "", (1.0 - impact.speed[0] / exact.speed) / dispersed.loss, 1.0},
        {"max (H - H~) / H0", "", run.energies.excess, 0.0, 1.0}};
    return level;
}

/// Corners of the exact pressure and velocity; jumps are two rows at one time.
apps::Table exact_table() {
    const ExactBounce exact(0.0);
    const double hit = exact.hit(), release = hit + Bar{}.contact_time(), pressure = exact.pressure(0.0);
    const double v = ExactBounce::speed;
    return {
        .columns = {"time", "pressure", "speed"},
        .rows = {
            {0.0, 0.0, -v}, {hit, 0.0, -v}, {hit, pressure, -v}, {release, pressure, v}, {release, 0.0, v}, {end, 0.0, v}}};
}

Picture picture(const BarOptions& options) {
    const std::string script = fmt::format(
        "set multiplot\nset xrange [0.4:1.3]\nset key bottom center\n"
        "set origin 0,0.45\nset size 1,0.55\nset ylabel \"contact pressure [Pa]\"\nset yrange [-20:480]\n"
        "set title \"Bar on a rigid wall, {0}, Courant number {1:g}\" noenhanced\n"
        "plot {2}, \\\n     \"exact.csv\" using \"time\":\"pressure\" with lines lw 2 lc rgb \"black\" title \"exact\"\n"
        "unset title\nset origin 0,0\nset size 1,0.45\nset key bottom right\nset xlabel \"time [s]\"\n"
        "set ylabel \"centre of mass [m/s]\"\nset yrange [-11:11]\n"
        "plot {3}, \\\n     \"exact.csv\" using \"time\":\"speed\" with lines lw 2 lc rgb \"black\" title \"exact\"\n"
        "unset multiplot\n",
        options.body_name(), options.cfl, history_lines(options.cells, "middle", "column(\"pressure\")"),
        history_lines(options.cells, "time", "column(\"speed_1\")"));
    return {
        .name = program.name, .purpose = "Pressure and velocity, from the .csv files beside this file", .script = script};
}

void run_study(const BarOptions& options) {
    run_study(program, options,
              {.title = "an elastic bar hits a rigid wall at v0 = 10 m/s",
               .reference = "d'Alembert's solution: contact for 2L/c at the pressure v0 sqrt(E rho), rebound at v0",
               .run = [&](std::size_t i) { return run_bar(scene(), options, options.cells[i]); },
               .level = [&](const BarRun& run, std::size_t i) { return level(run, options, options.cells[i]); },
               .exact = exact_table(),
               .picture = picture(options)});
}

const bool is_listed = list(entry_of(
    program, default_bar_options(program, {50, 100, 200, 400}),
    [](Flags& flags, BarOptions& options) { add_bar_options(flags, options); }, run_study));

}  // namespace

}  // namespace abut::studies::bar_impact_study
