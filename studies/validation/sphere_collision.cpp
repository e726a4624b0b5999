// Two spheres of aluminium run into each other: approach, force and duration against Hertz's quasi-static impact.
//
// R = 0.1 m, E = 70 GPa, nu = 0.3, rho = 2700 kg/m^3, coming closer at 0.5 m/s: 118.9 um, 14.86 kN, 700 us. Waves cross a
// sphere ten times in that time, so that the impact is nearly quasi-static. The contact is 2.4 mm in radius: cells are
// 0.4 mm there and grow with the distance.
//
// The momentum of a step holds the parasitic mode, which changes its sign with every step: the force of one step is off by
// as much. The mean of two steps in a row is free of it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "abut/run/option_table.hpp"
#include "apps/support/preset.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/impacts.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::sphere_collision_study {
namespace {

const apps::Program program{.name = "sphere_collision",
                            .purpose = "Two spheres of aluminium that collide: approach, force and duration against Hertz.",
                            .footer = "The spheres: R = 0.1 m, E = 70 GPa, nu = 0.3, rho = 2700 kg/m^3, 0.5 m/s."};

struct Options {
    std::vector<double> faces{2.0, 4.0};
    TwoSpheres spheres;
    run::RunOptions run{.out = "out/" + program.name};
};

constexpr double target = 0.03;

std::string curve_name(double faces) { return fmt::format("impact_{:g}", faces); }

struct Impact {
    Level level;
    apps::Table curve;
};

Impact collide(const TwoSpheres& spheres, const run::RunOptions& options) {
    const run::Scene<3> scene = two_spheres(spheres);
    const auto [result, observer, seconds] = run_impact(scene, options);
    const HertzImpact hertz = hertz_impact(spheres);
    Impact impact;
    impact.curve.columns = {"time", "approach", "force", "force_of_two"};
    double approach = 0.0, force = 0.0, before = 0.0, of_two = 0.0;
    for (const auto& sample : observer.samples()) {
        const double closer = (sample.displacement[0] - sample.displacement[1]).x() - spheres.gap * hertz.approach;
        const double present = -sample.force.x(), mean = 0.5 * (before + present);
        impact.curve.rows.push_back({sample.time - observer.first_contact(), closer, present, mean});
        approach = std::max(approach, closer);
        force = std::max(force, present);
        of_two = std::max(of_two, mean);
        before = present;
    }
    const double rebound = (observer.samples().back().velocity[1] - observer.samples().back().velocity[0]).x();
    const double asked = spheres.faces >= 6.0 ? target : no_target;
    impact.level = {
        .name = fmt::format("a/h = {:g}, {} cells, {} steps", spheres.faces, scene.mesh.n_cells(), result.run.steps),
        .size = hertz.contact_radius / spheres.faces,
        .quantities = {{"largest approach", "m", approach, hertz.approach, 0.0, asked},
                       {"largest force", "N", force, hertz.force, 0.0, asked},
                       {"largest force, mean of two steps", "N", of_two, hertz.force, 0.0, asked},
                       {"duration", "s", observer.last_contact() - observer.first_contact(), hertz.duration, 0.0, asked},
                       {"speed of separation", "m/s", rebound, spheres.speed},
                       {"momentum, largest change", "",
                        result.ledger.momentum_drift() / (0.5 * spheres.speed * result.bodies.start[0].mass), 0.0, 1.0,
                        1e-12}},
        .energies = figures_of(result),
        .seconds = seconds};
    return impact;
}

/// Hertz's law of motion, m* d'' = -k d^1.5, integrated by small steps: time, approach, force.
apps::Table exact_curve(const TwoSpheres& spheres) {
    constexpr int steps = 4000, rows = 200;
    const HertzImpact hertz = hertz_impact(spheres);
    const double k = hertz.force / std::pow(hertz.approach, 1.5);
    const double mass =
        0.8 * k * std::pow(hertz.approach, 2.5) / (spheres.speed * spheres.speed);  // all energy in d at rest
    const double dt = hertz.duration / steps;
    apps::Table table{.columns = {"time", "approach", "force"}};
    double d = 0.0, v = spheres.speed;
    for (int i = 0; i <= steps; ++i) {
        const double force = k * std::pow(std::max(0.0, d), 1.5);
        if (i % (steps / rows) == 0) table.rows.push_back({i * dt, d, force});
        v -= 0.5 * dt * force / mass;
        d += dt * v;
        v -= 0.5 * dt * k * std::pow(std::max(0.0, d), 1.5) / mass;
    }
    return table;
}

/// Hertz's curve and a line for each level: `value` in terms of the columns, over the time.
std::string lines(const std::vector<double>& faces, const std::string& of_hertz, const std::string& computed) {
    static constexpr std::array<const char*, 3> colours{"#eb6834", "#2a78d6", "#3c9d5b"};
    const std::string time = "(1e6*column(\"time\"))";
    std::string script =
        fmt::format("plot \"hertz.csv\" using {}:({}) with lines lw 6 lc rgb \"#b9b8b4\" title \"Hertz\"", time, of_hertz);
    for (std::size_t i = 0; i < faces.size(); ++i)
        script += fmt::format(", \\\n     \"{}.csv\" using {}:({}) with lines lw 1.5 lc rgb \"{}\" title \"a/h = {:g}\"",
                              curve_name(faces[i]), time, computed, colours[i % colours.size()], faces[i]);
    return script + "\n";
}

Picture picture(const std::vector<double>& faces) {
    const std::string approach = "1e6*column(\"approach\")";
    const std::string script =
        "set multiplot\nset size 1,0.5\nset key top right samplen 2\nset xrange [0:*]\nset autoscale xfixmax\n"
        "set origin 0,0.5\nset title \"two spheres of aluminium, 0.5 m/s\" font \",15\"\n"
        "set ylabel \"force, mean of two steps [kN]\"\n" +
        lines(faces, "1e-3*column(\"force\")", "1e-3*column(\"force_of_two\")") +
        "unset title\nset origin 0,0\nset yrange [0:*]\nset xlabel \"time since first contact [us]\"\n"
        "set ylabel \"approach of the centres [um]\"\n" +
        lines(faces, approach, approach) + "unset multiplot\n";
    return {.name = "impact",
            .purpose = "Force between the spheres and their approach, from the .csv files beside this file",
            .script = script};
}

void add_options(Flags& flags, Options& options) {
    flags.group("Scene");
    flags.numbers("--faces", options.faces,
                  "faces in the largest contact radius, a number a level; from 6 on there are targets",
                  {.above = 1.0, .below = 100.0});
    flags.number("--coarse", options.spheres.coarse, "size of cells far from the contact over the radius",
                 {.above = 0.0, .below = 1.0});
    apps::add_preset_option(flags, options.run);
    apps::add_time_options(flags, options.run, "1.2 times Hertz's duration");
    apps::add_contact_options(flags, options.run);
    flags.out(options.run.out);
}

void run_study(Options& options) {
    std::vector<std::string> curves{"hertz"};
    for (const double faces : options.faces) curves.push_back(curve_name(faces));
    const auto lock = prepare_study(program, options.run.out, curves, {"impact"});
    Study study{.title = "two spheres that collide", .reference = "Hertz: m* d'' = -4/3 E* sqrt(R*) d^1.5"};
    study.curves.emplace_back("hertz", exact_curve(options.spheres));
    for (const double faces : options.faces) {
        options.spheres.faces = faces;
        Impact impact = collide(options.spheres, options.run);
        study.levels.push_back(std::move(impact.level));
        study.curves.emplace_back(curve_name(faces), std::move(impact.curve));
    }
    study.pictures = {picture(options.faces)};
    study.options = run::named_values(options.run);
    apps::append(study.options, {{"faces", options.faces}, {"coarse", options.spheres.coarse}});
    report(program, options.run.out, study);
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::sphere_collision_study
