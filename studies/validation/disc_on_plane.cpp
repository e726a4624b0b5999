// A disc falls on a rigid plane: when it touches, and how fast it is then.
//
// R = 20, lambda = mu = 20, rho = 1, body force 0.1, lowest point 5 above the plane: it touches at t = 10 at the speed 1.
// The disc of the mesh is a polygon whose faces feel the plane at their centroids: it is late by the time in which it falls
// by what these are higher than the circle, at most h^2/(8R), and by a step.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "abut/run/option_table.hpp"
#include "apps/support/preset.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/impacts.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::disc_on_plane_study {
namespace {

const apps::Program program{
    .name = "disc_on_plane",
    .purpose = "Disc that falls on a rigid plane: time and speed of first contact, energies of the rebound.",
    .footer = "The disc: R = 20 m, lambda = mu = 20 Pa, rho = 1 kg/m^3, 0.1 m/s^2, 5 m above the plane."};

struct Options {
    std::vector<double> cells{5.0, 10.0, 20.0};  // in the radius, one per level
    run::RunOptions run{.out = "out/" + program.name};
};

std::string curve_name(double cells) { return fmt::format("fall_{:g}", cells); }

struct Fall {
    Level level;
    apps::Table curve;
};

Fall fall(const DroppedDisc& disc, const run::RunOptions& options) {
    const run::Scene<2> scene = dropped_disc(disc);
    const auto [result, observer, seconds] = run_impact(scene, options);
    const double time = std::sqrt(2.0 * disc.height / disc.gravity), speed = disc.gravity * time;
    const double late = disc.size * disc.size / (8.0 * disc.radius) / speed + result.run.dt;
    Fall fall;
    double speed_at_contact = 0.0;
    for (const auto& sample : observer.samples()) {
        if (sample.time <= observer.first_contact()) speed_at_contact = -sample.velocity[0].y();
        fall.curve.rows.push_back({sample.time, sample.displacement[0].y(), sample.velocity[0].y(), sample.force.y()});
    }
    fall.curve.columns = {"time", "displacement", "velocity", "force"};
    fall.level = {.name = fmt::format("R/h = {:g}, {} cells, {} steps", disc.radius / disc.size, scene.mesh.n_cells(),
                                      result.run.steps),
                  .size = disc.size,
                  .quantities = {{"first contact", "s", observer.first_contact(), time, 0.0, late / time},
                                 {"speed at first contact", "m/s", speed_at_contact, speed, 0.0, late / time},
                                 {"energy at the end, true error", "",
                                  result.ledger.energy_drift() / result.energy.scale.value, 0.0, 1.0}},
                  .energies = figures_of(result),
                  .seconds = seconds};
    return fall;
}

/// A line for each number of cells in the radius: `value` over time.
std::string lines(const std::vector<double>& cells, const std::string& value, const std::string& how) {
    static constexpr std::array<const char*, 3> colours{"#eb6834", "#3c9d5b", "#2a78d6"};
    std::string script;
    for (std::size_t i = 0; i < cells.size(); ++i)
        script += fmt::format(", \\\n     \"{}.csv\" using \"time\":({}) with {} lc rgb \"{}\" title \"R/h = {:g}\"",
                              curve_name(cells[i]), value, how, colours[i % colours.size()], cells[i]);
    return script;
}

/// The whole motion above; below it, from just before the contact, what the velocity has gained over free fall.
Picture picture(const std::vector<double>& cells) {
    const std::string velocity = "column(\"velocity\")";
    const std::string script = fmt::format(
        "set multiplot\nset samples 1000\nset size 1,0.55\nset origin 0,0.45\n"
        "set title \"disc that falls on a plane\" font \",15\"\nset key top left samplen 2\nset xrange [0:40]\n"
        "set ylabel \"velocity of the centre of mass [m/s]\"\n"
        "plot (x <= 10 ? -0.1*x : 1/0) with lines lw 6 lc rgb \"#b9b8b4\" title \"free fall, until 10 s\"{}\n"
        "unset title\nset size 1,0.45\nset origin 0,0\nset xrange [9.5:10.75]\nset yrange [-0.002:0.04]\n"
        "set xlabel \"time [s]\"\nset ylabel \"velocity - free fall [m/s]\"\n"
        "plot (x <= 10 ? 0 : 1/0) with lines lw 6 lc rgb \"#b9b8b4\" title \"exact, until 10 s\"{}\nunset multiplot\n",
        lines(cells, velocity, "lines lw 1.5"), lines(cells, velocity + "+0.1*column(\"time\")", "linespoints pt 7 ps 0.6"));
    return {.name = "fall", .purpose = "Velocity of the disc, from the .csv files beside this file", .script = script};
}

void add_options(Flags& flags, Options& options) {
    flags.group("Scene");
    flags.numbers("--cells", options.cells, "cells in the radius, a number a level", {.above = 1.0, .below = 1000.0});
    apps::add_preset_option(flags, options.run);
    apps::add_time_options(flags, options.run, "4 times the fall");
    apps::add_contact_options(flags, options.run);
    flags.out(options.run.out);
}

void run_study(const Options& options) {
    std::vector<std::string> curves;
    for (const double cells : options.cells) curves.push_back(curve_name(cells));
    const auto lock = prepare_study(program, options.run.out, curves, {"fall"});
    Study study{.title = "disc that falls on a rigid plane", .reference = "free fall: t = sqrt(2 h/g), v = g t"};
    for (const double cells : options.cells) {
        DroppedDisc disc;
        disc.size = disc.radius / cells;
        Fall one = fall(disc, options.run);
        study.levels.push_back(std::move(one.level));
        study.curves.emplace_back(curve_name(cells), std::move(one.curve));
    }
    study.pictures = {picture(options.cells)};
    study.options = run::named_values(options.run);
    study.options.push_back({"cells", options.cells});
    report(program, options.run.out, study);
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::disc_on_plane_study
