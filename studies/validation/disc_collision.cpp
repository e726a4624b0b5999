// Two discs run into each other, head-on and off-centre: momentum, energies, final speeds, and no spin.
//
// R = 1, E = 1, nu = 0.3, rho = 1, each at 0.05, 0.02 apart, offset 0 or 0.8. There is no closed form: a prototype of the
// method gave final speeds of +-(0.0477, 0.001) and +-(0.0278, 0.0394) with cells of 0.25, on other meshes. What must hold
// exactly is momentum; contact is without friction, so that a disc begins to turn only by what its faces miss of a circle.
#include <fmt/format.h>

#include <array>

#include "abut/run/option_table.hpp"
#include "apps/support/preset.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/impacts.hpp"
#include "studies/schemes/comparison.hpp"
#include "studies/table/study.hpp"

namespace abut::studies::disc_collision_study {
namespace {

const apps::Program program{.name = "disc_collision",
                            .purpose = "Two discs that collide head-on and off-centre: momentum, energies, speeds and spin.",
                            .footer = "The discs: R = 1 m, E = 1 Pa, nu = 0.3, rho = 1 kg/m^3, 0.05 m/s each."};

constexpr std::array offsets{0.0, 0.8};  // of the centres [m]

struct Options {
    std::vector<double> sizes{0.25, 0.125, 0.0625};
    run::RunOptions run{.out = "out/" + program.name};
};

/// Velocity that a prototype of the method gave for the disc on the left [m/s].
Vector<2> prototype(double offset) { return offset == 0.0 ? Vector<2>(-0.0477, -0.001) : Vector<2>(-0.0278, -0.0394); }

/// Name of the file with the velocities of a run.
std::string curve_name(double offset, double size) {
    return fmt::format("{}_{:g}", offset == 0.0 ? "head_on" : "off_centre", size);
}

struct Collision {
    Level level;
    apps::Table curve;
};

apps::Table curve(const ImpactObserver<2>& observer) {
    apps::Table table{.columns = {"time", "left_x", "left_y", "right_x", "right_y"}, .rows = {}};
    for (const auto& sample : observer.samples()) {
        const auto& [left, right] = sample.velocity;
        table.rows.push_back({sample.time, left.x(), left.y(), right.x(), right.y()});
    }
    return table;
}

Collision collide(const TwoDiscs& discs, const run::RunOptions& options) {
    const run::Scene<2> scene = two_discs(discs);
    const auto [result, observer, seconds] = run_impact(scene, options);
    const double momentum = discs.density * std::numbers::pi * discs.radius * discs.radius * discs.speed;
    const auto& last = observer.samples().back();
    const Vector<2> expected = prototype(discs.offset);
    Level level{.name = fmt::format("offset {:g}, h = {:g}, {} cells, {} steps", discs.offset, discs.size,
                                    scene.mesh.n_cells(), result.run.steps),
                .quantities = {{"momentum, largest change", "", result.ledger.momentum_drift() / momentum, 0.0, 1.0, 1e-12},
                               {"pseudo-energy, largest drift over K0", "",
                                result.ledger.pseudo_energy_drift() / result.energy.scale.value, 0.0, 1.0, 1e-12},
                               {"final speed along x", "m/s", last.velocity[0].x(), expected.x(), discs.speed},
                               {"final speed along y", "m/s", last.velocity[0].y(), expected.y(), discs.speed},
                               {"spin times R, over the speed", "", last.spin * discs.radius, 0.0, discs.speed},
                               {"angular momentum, largest change", "",
                                result.ledger.angular_momentum_drift() / (momentum * discs.radius), 0.0, 1.0}},
                .energies = figures_of(result),
                .seconds = seconds};
    return {std::move(level), curve(observer)};
}

/// Velocities of both discs along x or y at one offset, a colour a size, over those that the prototype ended with.
std::string panel(const std::vector<double>& sizes, double offset, int axis) {
    static constexpr std::array<const char*, 4> colours{"#eb6834", "#2a78d6", "#3c9d5b", "#8a4fc7"};
    const char coordinate = axis == 0 ? 'x' : 'y';
    const double end = prototype(offset)[axis];
    std::string script = fmt::format(
        "set title \"two discs, {}\" font \",15\"\nset ylabel \"velocity along {} [m/s]\"\n"
        "plot {} with lines lw 6 lc rgb \"#cfcdc8\" title \"prototype, final\", {} with lines lw 6 lc rgb \"#cfcdc8\" "
        "notitle",
        offset == 0.0 ? "head-on" : fmt::format("off-centre by {:g} m", offset), coordinate, end, -end);
    for (std::size_t i = 0; i < sizes.size(); ++i)
        for (const auto& [disc, dashes] : {std::pair("left", 1), std::pair("right", 2)})
            script += fmt::format(
                ", \\\n     \"{}.csv\" using \"time\":\"{}_{}\" with lines lw 1.6 dt {} lc rgb \"{}\" "
                "title \"{} disc, h = {:g} m\"",
                curve_name(offset, sizes[i]), disc, coordinate, dashes, colours[i % colours.size()], disc, sizes[i]);
    return script + "\n";
}

/// Head-on on the left, off-centre on the right; x above, y below. One legend is enough.
Picture picture(const std::vector<double>& sizes) {
    std::string script =
        "set multiplot\nset size 0.5,0.5\nset xlabel \"time [s]\"\nset autoscale xfix\nset yrange [-0.06:0.06]\n"
        "set key center right samplen 2 opaque\n";
    for (const int axis : {0, 1})
        for (const double offset : offsets) {
            script += fmt::format("set origin {},{}\n", offset == 0.0 ? 0.0 : 0.5, axis == 0 ? 0.5 : 0.0);
            script += panel(sizes, offset, axis) + "unset key\n";
        }
    return {.name = "velocities",
            .purpose = "Velocities of the centres of mass, from the .csv files beside this file",
            .width = 1400,
            .script = script + "unset multiplot\n"};
}

void run_study(const Options& options) {
    std::vector<std::string> curves;
    for (const double offset : offsets)
        for (const double size : options.sizes) curves.push_back(curve_name(offset, size));
    const auto lock = prepare_study(program, options.run.out, curves, {"velocities"});
    Study study{.title = "two discs that collide", .reference = "laws of conservation; speeds: a prototype on other meshes"};
    for (const double offset : offsets)
        for (const double size : options.sizes) {
            Collision collision = collide({.offset = offset, .size = size}, options.run);
            study.levels.push_back(std::move(collision.level));
            study.curves.emplace_back(curve_name(offset, size), std::move(collision.curve));
        }
    study.pictures = {picture(options.sizes)};
    study.options = run::named_values(options.run);
    study.options.push_back({"size", options.sizes});
    report(program, options.run.out, study);
}

void add_options(Flags& flags, Options& options) {
    flags.group("Scene");
    flags.numbers("--size", options.sizes, "sizes of cells, one per level", {.unit = "m", .above = 0.0, .below = 1.0});
    apps::add_preset_option(flags, options.run);
    apps::add_time_options(flags, options.run, "the approach and 6 crossings of a disc by a wave");
    apps::add_contact_options(flags, options.run);
    flags.out(options.run.out);
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run_study));

}  // namespace

}  // namespace abut::studies::disc_collision_study
