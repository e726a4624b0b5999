// An elastic bar falls on a rigid wall and bounces: impulse of each impact, rise of the pressure and period of the motion.
// bouncing_bar compares integrators on the same bar, bouncing_strip shows a million steps; here the numbers are checked.
//
// L = 10, E = 900, rho = 1, nu = 0, so c = 30; gravity 10, from rest 5 above the wall. It hits at t = 1 with v0 = 10; a wave
// runs up and down in 2L/c = 2/3, and the foot, which would go on falling, is held: p = rho c (v0 + g t), from 300 to 500,
// impulse 2 rho L (v0 + g L/c) = 266.667. The bar leaves pressed by its own weight, vibrates with the period 2L/c, and comes
// back after 2 s = 3 periods in that same state: the second impact is the first one backwards, and after 16/3 s the bar is
// at rest where it began.
//
// The front that ends the first impact is one of 600, from 500 to -100 if the wall could pull: what dispersion has made of
// it (dispersed_impact) reaches 0 where it is over by 5/6, late by an amount that goes like h^(2/3). From then on the fronts
// that run through the bar in flight are spread, too, and the later impacts are less accurate than the first.
#include <fmt/format.h>

#include "apps/support/choices.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/bars.hpp"

namespace abut::studies::falling_bar_study {
namespace {

constexpr double gravity = 10.0;  // [m/s^2]
constexpr double end = 7.5;       // of the run [s]: three impacts, the last one from 6.333 to 7
constexpr double round_trip = 16.0 / 3.0;
constexpr int asked_impacts = 3;
constexpr int least_cells = 100;  // from which on the targets hold that do not scale with h

const apps::Program program{.name = "falling_bar",
                            .purpose = "Bar that falls on a rigid wall and bounces: impulses, pressures and period.",
                            .footer = "The bar: L = 10 m, E = 900 Pa, rho = 1 kg/m^3, nu = 0; it falls 5 m at 10 m/s^2."};

BarOnWall scene() {
    const Bar bar;
    return {.bar = bar,
            .gap = ExactBounce::height,
            .gravity = gravity,
            .energy = bar.mass() * gravity * ExactBounce::height,
            .time = end};
}

/// Quantities of one impact, counted from 0.
std::vector<Quantity> of_impact(int number, const Impact& impact, const BarRun& run, bool is_fine) {
    const ExactBounce exact(gravity);
    const double asked = is_fine ? 3e-3 : no_target, duration = Bar{}.contact_time();
    const double low = exact.pressure(0.0), high = exact.pressure(duration);
    const bool backwards = number % 2 == 1;
    const auto name = [&](const char* what) { return fmt::format("impact {}: {}", number + 1, what); };
    const MiddlePressure pressure =
        middle_pressure(run.history, exact.hit(number), duration, [&](double t) { return exact.pressure_at(t); });
    return {{name("impulse"), "N s/m^2", impact.impulse, exact.impulse(), 0.0, asked},
            {name("pressure at its begin"), "Pa", pressure.at_begin, backwards ? high : low},
            {name("pressure at its end"), "Pa", pressure.at_end, backwards ? low : high},
            {name("pressure - exact, rms"), "Pa", pressure.rms, 0.0, pressure.mean}};
}

Level level(const BarRun& run, const BarOptions& options, int cells) {
    const Bar bar;
    const ExactBounce exact(gravity);
    const double h = bar.length / cells;
    Level level{.name = fmt::format("{}, {} cells", options.body_name(), cells), .size = h, .energies = run.energies};
    level.seconds = run.seconds;
    const auto found = impacts(run.history, 0.5 * bar.contact_time());
    if (found.size() < asked_impacts)
        throw std::runtime_error(
            fmt::format("{}: {} impacts are over by {} s, {} are expected.", level.name, found.size(), end, asked_impacts));
    for (int i = 0; i < asked_impacts; ++i)
        for (Quantity& quantity : of_impact(i, found[static_cast<std::size_t>(i)], run, cells >= least_cells))
            level.quantities.push_back(std::move(quantity));
    const double release = exact.hit() + bar.contact_time();
    level.quantities.push_back({"impact 1: released at", "s", found[0].end, release});
    level.quantities.push_back({"period, impacts 1 and 3", "s", found[2].begin - found[0].begin, round_trip});
    level.quantities.push_back({"max (H - H~) / H0", "", run.energies.excess, 0.0, 1.0});
    return level;
}

/// The exact pressure and velocity, with rows close enough to each side of a jump.
apps::Table exact_table() {
    const ExactBounce exact(gravity);
    apps::Table table{.columns = {"time", "pressure", "speed"}, .rows = {}};
    for (int i = 0; i <= 3000; ++i) {
        const double time = end * i / 3000.0;
        table.rows.push_back({time, exact.pressure_at(time), exact.velocity_at(time)});
    }
    return table;
}

Picture picture(const BarOptions& options) {
    const std::string script = fmt::format(
        "set multiplot\nset key top right\n"
        "set origin 0,0.68\nset size 1,0.32\nset ylabel \"contact pressure [Pa]\"\nset xrange [0:{0}]\nset yrange "
        "[-20:720]\n"
        "set title \"Bar that falls on a rigid wall, {1}, Courant number {2:g}\" noenhanced\nset key horizontal\n"
        "plot {3}, \\\n     {4} title \"exact\"\nunset title\nunset key\n"
        "set origin 0,0.36\nset size 0.5,0.32\nset ylabel \"first impact [Pa]\"\nset xrange [0.95:1.75]\nreplot\n"
        "set origin 0.5,0.36\nset ylabel \"second impact [Pa]\"\nset xrange [3.6:4.4]\nreplot\n"
        "set origin 0,0\nset size 1,0.36\nset xlabel \"time [s]\"\nset ylabel \"centre of mass [m/s]\"\n"
        "set xrange [0:{0}]\nset yrange [-11:11]\n"
        "plot {5}, \\\n     \"exact.csv\" using \"time\":\"speed\" with lines lw 1.5 dt 2 lc rgb \"black\"\nunset "
        "multiplot\n",
        end, options.body_name(), options.cfl, history_lines(options.cells, "middle", "column(\"pressure\")"),
        "\"exact.csv\" using \"time\":\"pressure\" with lines lw 2 lc rgb \"black\"",
        history_lines(options.cells, "time", "column(\"speed_1\")"));
    return {.name = program.name,
            .purpose = "Pressure and velocity, from the .csv files beside this file",
            .height = 1200,
            .script = script};
}

void run_study(const BarOptions& options) {
    run_study(program, options,
              {.title = "an elastic bar falls on a rigid wall and bounces",
               .reference = "closed form: p = rho c (v0 + g t) for 2L/c, backwards in every second impact; period 16/3 s",
               .run = [&](std::size_t i) { return run_bar(scene(), options, options.cells[i]); },
               .level = [&](const BarRun& run, std::size_t i) { return level(run, options, options.cells[i]); },
               .exact = exact_table(),
               .picture = picture(options)});
}

const bool is_listed = list(entry_of(
    program, default_bar_options(program, {50, 100, 200}),
    [](Flags& flags, BarOptions& options) { add_bar_options(flags, options); }, run_study));

}  // namespace

}  // namespace abut::studies::falling_bar_study
