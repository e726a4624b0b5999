// An elastic bar, a strip of cells two across, bounces on a rigid wall: what an energy that is conserved does not tell.
// bouncing_bar is the same bar as a chain, with all integrators.
//
// Length 10, E = 900, rho = 1, nu = 0, so c = 30; gravity 10 towards the wall, from rest 5 above it. It hits at t = 1 with
// speed 10; a pressure wave takes 2L/c to run up and down, pressure 300 rising to 500: impulse 266.667 an impact.
// H~ stays exact whatever happens, but each contact event kicks the undamped alternating mode of MEMM: watch |e| and
// H - H~ over a million steps (--steps 1000000) with and without the energy-neutral filter. docs/filter.md has the table.
#include <vector>

#include "abut/solid/contact_view.hpp"
#include "apps/support/run_scene.hpp"
#include "studies/program/entry.hpp"
#include "studies/scenes/bars.hpp"

namespace abut::studies::bouncing_strip_study {
namespace {

constexpr double gravity = 10.0;  // [m/s^2]
const Bar the_bar;
const double crossing = 0.5 * the_bar.contact_time();         // L/c [s]
const double exact_impulse = ExactBounce(gravity).impulse();  // an impact, per area of the bar [N s/m]

const apps::Program program{
    .name = "bouncing_strip",
    .purpose =
        "Bar, a strip of cells, that bounces on a rigid wall under gravity: pseudo-energy, energy and parasitic mode.",
    .series = "strip",
    .footer =
        "The bar: L = 10 m, E = 900 Pa, rho = 1 kg/m^3, nu = 0; it falls 5 m at 10 m/s^2. Ctrl-C ends a run after its "
        "present step; its files are complete until there."};

struct StripOptions {
    int cells = 100;
    double eta = 0.0;  // [Pa], 0: E
    run::RunOptions run{.steps = 10'000, .filter = true, .out = "out/" + program.name, .interval = 100};
    apps::Messages messages = apps::Messages::normal;
};

void add_options(Flags& flags, StripOptions& options) {
    const Limits eta{.unit = "Pa", .above = 0.0, .zero = true};
    flags.group("Bar");
    flags.count("--cells", options.cells, "cells along the bar; two across it", 4);
    flags.number("--eta", options.eta, "stabilisation of jumps between cells; 0: Young's modulus", eta);
    apps::add_time_options(flags, options.run, "--steps decides");
    apps::add_compression_limit(flags, options.run);
    apps::add_output_options(flags, options.run);
    apps::add_message_options(flags, options.messages);
}

/// Impulses of the wall, one per impact: contacts belong together that are apart by less than a wave takes through the bar.
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
    /// Impulses of impacts that are over.
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

std::vector<run::Finding> findings(const Impacts& impacts, const run::RunResult<2>& result) {
    const auto impulses = impacts.complete();
    const double largest =
        result.energy.scale.value + result.ledger.energy_excess();  // H~ is 0: the energy of the fall comes on top
    const run::Value first = impulses.empty() ? run::Value() : run::Value(impulses.front());
    return {{"impacts", "impacts that are over", static_cast<std::int64_t>(impulses.size())},
            {"impulse_first", "impulse of the first one [N s/m]", first},
            {"impulse_exact", "impulse, exact [N s/m]", exact_impulse},
            {"energy_largest", "largest energy, H0 + max (H - H~) [J]", largest},
            {"pseudo_energy_drift_relative", "drift / largest energy", result.ledger.pseudo_energy_drift() / largest}};
}

run::Scene<2> bar(const StripOptions& options, Impacts& impacts) {
    run::Scene<2> scene =
        bar_strip<2>({.bar = the_bar,
                      .gap = ExactBounce::height,
                      .gravity = gravity,
                      .energy = the_bar.mass() * gravity * ExactBounce::height,  // all kinetic at the first impact
                      .eta = options.eta},
                     options.cells);
    scene.after_step = [&impacts, area = strip_width(the_bar, options.cells)](const solid::Solid<2>& solid, double dt) {
        impacts.add(-solid.contact().obstacle_force(0).y() * dt / area, dt);
    };
    scene.findings = [&impacts](const run::RunResult<2>& result) { return findings(impacts, result); };
    return scene;
}

/// As entry_of makes it, but how many messages there are is an option.
int run_study(int argc, char** argv) {
    StripOptions options;
    // An impact at a third of the wave speed: the foot gives way by up to twice its cell, and more when vibration adds up.
    options.run.contact.compression_limit = 10.0;
    // Only the foot of the bar faces the wall: a thick skin costs nothing and lasts long.
    options.run.contact.search.skin = 0.1 * the_bar.length;
    Impacts impacts;
    apps::Program study = program, typed = as_typed(program);
    return run_command(
        typed, argc, argv, [&](Flags& flags) { add_options(flags, options); },
        [&] {
            study.messages = typed.messages = options.messages;
            apps::run_scene<2>(study, options.run, [&](Answers&) { return bar(options, impacts); });
        });
}

const bool is_listed = list({program.name, program.purpose, run_study});

}  // namespace

}  // namespace abut::studies::bouncing_strip_study
