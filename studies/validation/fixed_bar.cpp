// A pressed bar, fixed at one end, is let go: it flies to a rigid wall, pushes, and comes back to where it began.
//
// L = E = rho = 1, nu = 0, so c = 1; wall at x = 0, u(1, t) = 0, at rest with u(x, 0) = (1 - x)/2. The exact field, by
// characteristics (v - sigma runs upwards unchanged, v + sigma downwards), with the stress sigma and the velocity v:
//
//   t in [0, 1]: the free end lets the stress -1/2 go. Behind the front x = t: sigma = 0, v = -1/2, u = (1 - t)/2; ahead of
//                it nothing has changed: u = (1 - max(x, t))/2. At t = 1 the bar is undeformed, u = 0, v = -1/2 everywhere.
//   t in [1, 2]: s = t - 1. Both ends are stopped: sigma = -1/2 behind the front from the wall, +1/2 behind that from the
//                fixed end, v = 0 in both; ahead u = -s/2; where the fronts have passed each other sigma = 0, v = 1/2:
//                u = -min(x, 1 - x, s, 1 - s)/2. At t = 2 the bar is undeformed again, now with v = 1/2: the wall lets go.
//   t in [2, 3]: s = t - 2. The fixed end stops the bar, sigma = -1/2 behind the front: u = min(s, 1 - x)/2.
//
// At t = 3 all is as at t = 0. The front that ends the first contact has run the distance 2L since t = 0: it is as late as
// that of bar_impact. Contact stress 0, -1/2, 0 in the three parts of a period; energy 1/8 throughout.
#include <fmt/format.h>

#include <algorithm>

#include "apps/support/choices.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/bars.hpp"

namespace abut::studies::fixed_bar_study {
namespace {

constexpr double period = 3.0;                                 // [s]
constexpr double end = 2.0 * period;                           // of the run [s]
constexpr double contact_begin = 1.0, contact_duration = 1.0;  // in a period [s]
constexpr double stress = -0.5;                                // of the contact [Pa]
constexpr double energy = 0.125;                               // [J/m^2]
constexpr int least_cells = 100;                               // from which on the target of the stress holds
const Bar unit_bar{.length = 1.0, .young = 1.0, .density = 1.0};

const apps::Program program{
    .name = "fixed_bar",
    .purpose = "Bar, fixed at one end, that vibrates against a rigid wall: contact stress, period, field.",
    .footer = "The bar: L = 1 m, E = 1 Pa, rho = 1 kg/m^3, nu = 0; at the start u = (1 - x)/2, at rest."};

/// u(x, t), x from the wall [m].
double exact_displacement(double x, double time) {
    const double t = std::fmod(time, period), s = t - std::floor(t);
    if (t < 1.0) return 0.5 * (1.0 - std::max(x, t));
    if (t < 2.0) return -0.5 * std::min({x, 1.0 - x, s, 1.0 - s});
    return 0.5 * std::min(s, 1.0 - x);
}

/// Over the norm of u(., 0), 1/sqrt(12).
double l2_error(const BarProfile& profile) {
    double square = 0.0;
    for (const auto& [x, u, share] : profile.cells) {
        const double error = u - exact_displacement(x, profile.time);
        square += share * error * error;
    }
    return std::sqrt(12.0 * square);
}

BarOnWall scene() {
    return {.bar = unit_bar,
            .gap = 0.0,
            .held = true,
            .displacement = [](double x) { return exact_displacement(x, 0.0); },
            .energy = energy,
            .time = end};
}

/// Exact stress of the contact.
double exact_stress(double time) {
    const double t = std::fmod(time, period);
    return t > contact_begin && t < contact_begin + contact_duration ? stress : 0.0;
}

Level level(const BarRun& run, const BarOptions& options, int cells) {
    const double h = unit_bar.length / cells, wave_of_cell = 1.5 * h / unit_bar.wave_speed();
    Level level{.name = fmt::format("{}, {} cells", options.body_name(), cells), .size = h, .energies = run.energies};
    level.seconds = run.seconds;
    const auto found = impacts(run.history, 0.5 * contact_duration);
    if (found.size() < 2)
        throw std::runtime_error(
            fmt::format("{}: {} contacts are over by {} s, 2 are expected.", level.name, found.size(), end));
    const MiddlePressure pressure =
        middle_pressure(run.history, contact_begin, contact_duration, [](double t) { return -exact_stress(t); });
    const double release = contact_begin + contact_duration;
    const DispersedImpact dispersed = dispersed_impact(unit_bar, options.body, cells, options.cfl);
    level.quantities = {{"contact from", "s", found[0].begin, contact_begin, 0.0, wave_of_cell / contact_begin},
                        {"released at", "s", found[0].end, release, 0.0, wave_of_cell / release},
                        {"delay of release / that of dispersion", "", (found[0].end - release) / dispersed.delay, 1.0},
                        {"contact stress, mean", "Pa", -pressure.mean, stress, 0.0, cells >= least_cells ? 2e-3 : no_target},
                        {"contact stress - exact, rms", "Pa", pressure.rms, 0.0, -stress},
                        {"period, both contacts", "s", found[1].begin - found[0].begin, period, 0.0, wave_of_cell / period},
                        {"energy at the start", "J/m^2", run.energy_start, energy},
                        {"energy after two periods", "J/m^2", run.energy_end, energy},
                        {"displacement after a period, L2 error", "", l2_error(run.profiles[2]), 0.0, 1.0},
                        {"displacement after two periods, L2 error", "", l2_error(run.profiles[3]), 0.0, 1.0},
                        {"max (H - H~) / H0", "", run.energies.excess, 0.0, 1.0}};
    return level;
}

/// Times at which the profiles are taken [s].
const std::vector<double> profile_times = {0.5, 1.25, period, 2.0 * period};

void append_profiles(apps::Table& table, const BarRun& run, int cells) {
    for (std::size_t i = 0; i < run.profiles.size(); ++i)
        for (const auto& [x, u, share] : run.profiles[i].cells)
            table.rows.push_back(
                {static_cast<double>(cells), profile_times[i], x, u, exact_displacement(x, profile_times[i])});
}

/// Corners of the exact stress.
apps::Table exact_table() {
    apps::Table table{.columns = {"time", "pressure"}, .rows = {{0.0, 0.0}}};
    for (const double start : {0.0, period})
        for (const auto& [time, pressure] : std::initializer_list<std::pair<double, double>>{
                 {1.0, 0.0}, {1.0, -stress}, {2.0, -stress}, {2.0, 0.0}, {3.0, 0.0}})
            table.rows.push_back({start + time, pressure});
    return table;
}

/// Displacements of the finest mesh.
std::string profile_lines(int cells) {
    constexpr std::array colours = {"#eb6834", "#1f9e6e", "#2a78d6", "#8a4fc7"};
    std::string lines;
    for (std::size_t i = 0; i < profile_times.size(); ++i)
        lines += fmt::format(
            "{}\"profiles.csv\" using (column(\"cells\")=={}&&column(\"time\")=={}?column(\"x\"):NaN):\"{}\" with {} title "
            "\"{}\"",
            i == 0 ? "" : ", \\\n     ", cells, profile_times[i], "u",
            fmt::format("points pt 7 ps 0.5 lc rgb \"{}\"", colours[i]), fmt::format("t = {:g} s", profile_times[i]));
    return lines;
}

Picture picture(const BarOptions& options) {
    const int finest = std::ranges::max(options.cells);
    const std::string script = fmt::format(
        "set multiplot\nset key top right horizontal\n"
        "set origin 0,0.5\nset size 1,0.5\nset xlabel \"time [s]\"\nset ylabel \"minus contact stress [Pa]\"\n"
        "set xrange [0:{0}]\nset yrange [-0.1:1.05]\n"
        "set title \"Bar, fixed at one end, against a rigid wall, {1}, Courant number {2:g}\" noenhanced\n"
        "plot {3}, \\\n     \"exact.csv\" using \"time\":\"pressure\" with lines lw 2 lc rgb \"black\" title \"exact\"\n"
        "unset title\nset origin 0,0\nset xlabel \"distance from the wall x [m]\"\n"
        "set ylabel \"displacement [m], {4} cells\"\nset xrange [0:1]\nset yrange [-0.2:0.65]\n"
        "min(a,b) = a < b ? a : b\nmax(a,b) = a > b ? a : b\n"
        "plot {5}, \\\n     (1-max(x,0.5))/2 with lines lw 1.5 lc rgb \"black\" title \"exact\", \\\n"
        "     -min(min(x,1-x),0.25)/2 with lines lw 1.5 lc rgb \"black\" notitle, \\\n"
        "     (1-x)/2 with lines lw 1.5 lc rgb \"black\" notitle\n"
        "unset multiplot\n",
        end, options.body_name(), options.cfl, history_lines(options.cells, "middle", "column(\"pressure\")"), finest,
        profile_lines(finest));
    return {
        .name = program.name, .purpose = "Contact stress and field, from the .csv files beside this file", .script = script};
}

void run_study(const BarOptions& options) {
    apps::Table profiles{.columns = {"cells", "time", "x", "u", "exact"}, .rows = {}};
    const auto run_and_keep_profiles = [&](std::size_t i) {
        BarRun run = run_bar(scene(), options, options.cells[i], profile_times);
        append_profiles(profiles, run, options.cells[i]);
        return run;
    };
    run_study(program, options,
              {.title = "a pressed bar, fixed at one end, vibrates against a rigid wall",
               .reference = "d'Alembert's solution of period 3 s: contact stress 0, -1/2, 0 Pa, energy 1/8 J/m^2",
               .run = run_and_keep_profiles,
               .level = [&](const BarRun& run, std::size_t i) { return level(run, options, options.cells[i]); },
               .exact = exact_table(),
               .picture = picture(options),
               .more_curves = {"profiles"},
               .complete = [&](Study& study) { study.curves.emplace_back("profiles", std::move(profiles)); }});
}

const bool is_listed = list(entry_of(
    program, default_bar_options(program, {50, 100, 200, 400}, unit_bar.length),
    [](Flags& flags, BarOptions& options) { add_bar_options(flags, options); }, run_study));

}  // namespace

}  // namespace abut::studies::fixed_bar_study
