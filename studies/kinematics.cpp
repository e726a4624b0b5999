// Bodies that turn, however they move: small, floating, finite or rigid. What each keeps, where it is right, and what
// it costs.
//
// Cell-centred elasticity and rigid bodies touch by the potential of a pair (docs/method.md). Runs are asked for H~ less the
// work from outside, momentum, J~ = sum x × p - dt/4 sum v^- × p^+ where nothing holds the bodies, missed contacts and the
// force that closes the balance of energy; scenes are asked for closed forms: tops, times of impact, Hertz, a cradle,
// gears. No energy is claimed without H - H~, |e|/m and the number of events beside it.
#include "studies/kinematics/rows.hpp"
#include "studies/program/entry.hpp"

namespace abut::studies::kinematics {
namespace {

const std::vector<Part<Options, Row>> parts{
    {"free", "Blocks that spin freely: do they keep their size?", run_free},
    {"means", "Noise in finite bodies that spin: how long does each mean force hold?", run_means},
    {"tops", "Rigid tops beside their closed forms.", run_tops},
    {"wall", "A spinning square meets a wall: when?", run_wall},
    {"bar", "A slender bar is struck near its end and turns: does it grow?", run_bar},
    {"tumble", "Blocks fall on a plane and tumble.", run_tumble},
    {"ball", "A rigid ball bounces on an elastic block: for how long does it touch?", run_ball},
    {"bend", "A cantilever bends far, and is let go: where is its tip?", run_bend},
    {"chute", "A rigid disc slides down flat facets: does it begin to spin?", run_chute},
    {"cradle", "Five discs in a row: does the last one take the velocity?", run_cradle},
    {"spheres", "The same in space: of five spheres, does the last one take the velocity?", run_spheres},
    {"gears", "Two gears on axles: do they turn, and load each other, as the teeth are counted?", run_gears},
    {"rotor", "A rotor hits plates on springs: do the books and the impulses balance?", run_rotor},
    {"pile", "Polygons in a box under gravity; and what rigid bodies cost.", run_pile}};

const apps::Program program{
    .name = "kinematics",
    .purpose = "Small, floating, finite and rigid bodies: energies, momenta, closed forms, and what they cost.",
    .footer = "A target that is missed is said to be; the exit code is that of the program alone."};

void add_options(Flags& flags, Options& options) {
    add_part_options(flags, program, names_of(parts), options);
    flags.group("Time");
    flags.count("--steps", options.steps, "of the pile", 1);
    flags.count("--turns", options.turns, "of the first gear", 1);
    flags.group("Output");
    flags.count("--frames", options.frames, "for ParaView, of each run; 0: none", 0);
}

void run(const Options& options) {
    const run::NamedValues used{
        {"only", options.only}, {"quick", options.quick}, {"steps", options.steps}, {"turns", options.turns}};
    run_study_in_parts(
        program, parts, options, used,
        {.without = {"energy_drift", "angular_momentum_drift", "rest_angular_momentum_drift", "unseen_edges"}});
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run));

}  // namespace

}  // namespace abut::studies::kinematics
