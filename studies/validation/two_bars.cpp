// Two equal elastic bars collide head on: they exchange their velocities.
//
// L = 10, E = 900, rho = 1, nu = 0, so c = 30; each flies towards the other at 0.1 (--speed 0.1,0: one of them is at rest).
// At closing speed w the contact lasts 2L/c = 2/3 at the pressure rho c w/2 = 3, in both bars waves run to the far end and
// come back, and then each bar flies off, undeformed, with the velocity that the other one had. Where the bars are cut into
// different numbers of cells (--cells-2) their faces do not match, along or across; the solution is the same.
//
// Each bar sees a rigid wall at the speed w/2: release and velocities as in bar_impact. Unlike at a wall, two ends of equal
// width can slip off each other: the overlap shrinks whichever way they slip, V = p |g|/2 per area sinks with it, and a
// force p |g| per length of the edge drives them on, against the shear stiffness of the cells. With |g| ~ h w/c the slip is
// of the order h (w/c)^2: nothing in small strains. At --speed 10,10, strains of 1/3, the ends may slip off (with --cells 50
// --cells-2 70 they do), and the bars run through each other.
#include <fmt/format.h>

#include "abut/base/error.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/bars.hpp"

namespace abut::studies::two_bars_study {
namespace {

constexpr int least_cells = 100;    // from which on the targets hold that do not scale with h
constexpr double approach = 0.05;   // [s]
constexpr double free_time = 0.35;  // of flight after the contact, so that it is known to be over [s]

const apps::Program program{.name = "two_bars",
                            .purpose = "Two equal bars that collide head on: they exchange their velocities.",
                            .footer = "Each bar: L = 10 m, E = 900 Pa, rho = 1 kg/m^3, nu = 0; they meet after 0.05 s."};

struct Options {
    BarOptions bars = default_bar_options(program, {50, 100, 200, 400});
    std::vector<int> upper_cells;  ///< empty: those of the lower one
    apps::BodyValues speed{0.1, 0.1};

    [[nodiscard]] double closing_speed() const { return speed[0] + speed[1]; }
    [[nodiscard]] std::array<int, 2> cells(std::size_t level) const {
        return {bars.cells[level], upper_cells.empty() ? bars.cells[level] : upper_cells[level]};
    }
};

void add_options(Flags& flags, Options& options) {
    add_bar_options(flags, options.bars, {BarBody::strip2d, BarBody::strip3d});
    flags.group("Bar");
    flags.counts("--cells-2", options.upper_cells, "cells along the upper bar, as many numbers; by default as --cells", 8);
    flags.body_values("--speed", options.speed, "speed of the lower and the upper bar towards the other",
                      {.unit = "m/s", .above = 0.0, .zero = true});
}

void check(const Options& options) {
    if (!options.upper_cells.empty() && options.upper_cells.size() != options.bars.cells.size())
        throw BadInput(fmt::format("--cells-2: {} numbers are given, --cells has {}. Give as many.",
                                   options.upper_cells.size(), options.bars.cells.size()));
    if (options.closing_speed() == 0.0)
        throw BadInput("--speed: 0 m/s for both bars, they never meet. Give one of them a speed above 0 m/s.");
}

TwoBars scene(const Options& options) {
    TwoBars scene{.gap = approach * options.closing_speed(), .speed = options.speed};
    scene.time = approach + scene.bar.contact_time() + free_time;
    return scene;
}

Level level(const BarRun& run, const Options& options, std::array<int, 2> cells) {
    const TwoBars bars = scene(options);
    const double h = bars.bar.length / std::ranges::min(cells), closing = options.closing_speed();
    const double pressure = bars.bar.impedance() * 0.5 * closing, duration = bars.bar.contact_time();
    const bool is_fine = std::ranges::min(cells) >= least_cells;
    const auto from_least = [&](double allowed) { return is_fine ? allowed : no_target; };
    Level level{.name = fmt::format("{}, {} and {} cells", options.bars.body_name(), cells[0], cells[1]), .size = h};
    level.energies = run.energies;
    level.seconds = run.seconds;
    const auto found = impacts(run.history, 0.5 * free_time);
    if (found.empty()) throw std::runtime_error(level.name + ": the bars are still in contact at the end of the run.");
    const Impact& impact = found.front();
    const double exchanged = (impact.speed[1] - impact.speed[0]) / closing;
    const MiddlePressure middle = middle_pressure(run.history, approach, duration, [&](double) { return pressure; });
    level.quantities = {
        {"lower bar, velocity after", "m/s", impact.speed[0], 0.0 - options.speed[1], closing, from_least(0.015)},
        {"upper bar, velocity after", "m/s", impact.speed[1], options.speed[0], closing, from_least(0.015)},
        {"exchanged", "", exchanged, 1.0, 0.0, from_least(0.015)},
        {"contact lasts", "s", impact.end - impact.begin, duration, 0.0, 1.5 * h / bars.bar.wave_speed() / duration},
        {"pressure, mean", "Pa", middle.mean, pressure, 0.0, from_least(2e-3)},
        {"pressure - exact, rms", "Pa", middle.rms, 0.0, pressure},
        {"max (H - H~) / K0", "", run.energies.excess, 0.0, 1.0}};
    if (cells[0] != cells[1]) return level;
    const DispersedImpact dispersed = dispersed_impact(bars.bar, options.bars.body, cells[0], options.bars.cfl);
    level.quantities.push_back(
        {"delay of release / that of dispersion", "", (impact.end - approach - duration) / dispersed.delay, 1.0});
    level.quantities.push_back({"loss of speed / that of dispersion", "", (1.0 - exchanged) / dispersed.loss, 1.0});
    return level;
}

/// Corners of the exact pressure and velocities; jumps are two rows at one time.
apps::Table exact_table(const Options& options) {
    const TwoBars bars = scene(options);
    const double release = approach + bars.bar.contact_time();
    const double pressure = bars.bar.impedance() * 0.5 * options.closing_speed(), v_1 = options.speed[0],
                 v_2 = -options.speed[1];
    return {.columns = {"time", "pressure", "speed_1", "speed_2"},
            .rows = {{0.0, 0.0, v_1, v_2},
                     {approach, 0.0, v_1, v_2},
                     {approach, pressure, v_1, v_2},
                     {release, pressure, v_2, v_1},
                     {release, 0.0, v_2, v_1},
                     {bars.time, 0.0, v_2, v_1}}};
}

Picture picture(const Options& options) {
    const auto& cells = options.bars.cells;
    const double pressure = 0.5 * Bar{}.impedance() * options.closing_speed(), margin = 0.05 * options.closing_speed();
    const std::string script = fmt::format(
        "set multiplot\nset xrange [0:{0}]\nset key top right horizontal\n"
        "set origin 0,0.5\nset size 1,0.5\nset ylabel \"contact pressure [Pa]\"\nset yrange [{1}:{2}]\n"
        "set title \"Two equal bars head on, {3}, Courant number {4:g}\" noenhanced\n"
        "plot {5}, \\\n     \"exact.csv\" using \"time\":\"pressure\" with lines lw 2 lc rgb \"black\" title \"exact\"\n"
        "unset title\nunset key\nset origin 0,0\nset xlabel \"time [s]\"\nset ylabel \"centres of mass [m/s]\"\n"
        "set yrange [{6}:{7}]\nplot {8}, \\\n     {9}, \\\n"
        "     for [v in \"speed_1 speed_2\"] \"exact.csv\" using \"time\":v with lines lw 2 dt 2 lc rgb \"black\"\n"
        "unset multiplot\n",
        scene(options).time, -0.05 * pressure, 1.5 * pressure, options.bars.body_name(), options.bars.cfl,
        history_lines(cells, "middle", "column(\"pressure\")"), -1.1 * options.speed[1] - margin,
        1.1 * options.speed[0] + margin, history_lines(cells, "time", "column(\"speed_1\")"),
        history_lines(cells, "time", "column(\"speed_2\")"));
    return {
        .name = program.name, .purpose = "Pressure and velocities, from the .csv files beside this file", .script = script};
}

void run_study(const Options& options) {
    check(options);
    const auto add_options_used = [&](Study& study) {
        study.options.push_back({"speed", std::vector<double>(options.speed.begin(), options.speed.end())});
        study.options.push_back({"cells_2", counts(options.upper_cells.empty() ? options.bars.cells : options.upper_cells)});
    };
    run_study(program, options.bars,
              {.title = fmt::format("two equal bars meet head on at {:g} and {:g} m/s", options.speed[0], options.speed[1]),
               .reference = "d'Alembert's solution: contact for 2L/c at the pressure rho c w/2, velocities exchanged",
               .run = [&](std::size_t i) { return run_two_bars(scene(options), options.bars, options.cells(i)); },
               .level = [&](const BarRun& run, std::size_t i) { return level(run, options, options.cells(i)); },
               .exact = exact_table(options),
               .picture = picture(options),
               .complete = add_options_used});
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::two_bars_study
