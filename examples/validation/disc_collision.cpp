// Two discs run into each other, head-on and off-centre: momentum, energies, final speeds, and no spin.
//
// R = 1, E = 1, nu = 0.3, rho = 1, each at 0.05, 0.02 apart, offset 0 or 0.8. There is no closed form: a prototype of the
// method gave final speeds of +-(0.0477, 0.001) and +-(0.0278, 0.0394) with cells of 0.25, on other meshes. What must hold
// exactly is momentum; contact is without friction, so that a disc begins to turn only by what its faces miss of a circle.
#include <fmt/format.h>

#include <cmath>

#include "scenes/impacts.hpp"
#include "support/choices.hpp"
#include "support/comparison.hpp"
#include "validation/study.hpp"

namespace abut::examples {
namespace {

const Program program{.name = "disc_collision",
                      .purpose = "Two discs that collide head-on and off-centre: momentum, energies, speeds and spin.",
                      .footer = "The discs: R = 1 m, E = 1 Pa, nu = 0.3, rho = 1 kg/m^3, 0.05 m/s each."};

struct Options {
    std::vector<double> sizes{0.25, 0.125, 0.0625};
    RunOptions run{.out = "out/" + program.name};
};

/// What a prototype of the method gave for the disc on the left [m/s].
Vector<2> prototype(double offset) { return offset == 0.0 ? Vector<2>(-0.0477, -0.001) : Vector<2>(-0.0278, -0.0394); }

Level collide(const TwoDiscs& discs, const RunOptions& options) {
    const Scene<2> scene = two_discs(discs);
    const auto [result, observer, seconds] = run_impact(scene, options);
    const double momentum = discs.density * std::numbers::pi * discs.radius * discs.radius * discs.speed;
    const auto& last = observer.samples().back();
    const Vector<2> expected = prototype(discs.offset);
    return {.name = fmt::format("offset {:g}, h = {:g}, {} cells, {} steps", discs.offset, discs.size, scene.mesh.n_cells(),
                                result.steps),
            .quantities = {{"momentum, largest change", "", result.ledger.momentum_drift() / momentum, 0.0, 1.0, 1e-12},
                           {"pseudo-energy, largest drift over K0", "",
                            result.ledger.pseudo_energy_drift() / result.scale.value, 0.0, 1.0, 1e-12},
                           {"final speed along x", "m/s", last.velocity[0].x(), expected.x(), discs.speed},
                           {"final speed along y", "m/s", last.velocity[0].y(), expected.y(), discs.speed},
                           {"spin times R, over the speed", "", last.spin * discs.radius, 0.0, discs.speed},
                           {"angular momentum, largest change", "",
                            result.ledger.angular_momentum_drift() / (momentum * discs.radius), 0.0, 1.0}},
            .energies = energy_figures(result),
            .seconds = seconds};
}

}  // namespace
}  // namespace abut::examples

int main(int argc, char** argv) {
    using namespace abut::examples;
    Options options;
    const auto add_options = [&](CLI::App& app) {
        add_numbers(app, "--size", options.sizes, "sizes of cells, one a level", {.unit = "m", .above = 0.0, .below = 1.0})
            ->group("Scene");
        add_time_options(app, options.run, "the approach and 6 crossings of a disc by a wave");
        add_contact_options(app, options.run);
        add_out_option(app, options.run.out);
    };
    return run_program(program, argc, argv, add_options, [&] {
        prepare_study(options.run.out, {}, {});
        Study study{.title = "two discs that collide",
                    .reference = "laws of conservation; speeds: a prototype on other meshes"};
        for (const double offset : {0.0, 0.8})
            for (const double size : options.sizes)
                study.levels.push_back(collide({.offset = offset, .size = size}, options.run));
        study.options = to_json(options.run);
        study.options["size"] = options.sizes;
        report(program, options.run.out, study);
    });
}
