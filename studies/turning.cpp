// Contact on nodes, of bodies that turn: what it keeps, where it is right, and where it ends.
//
// Linear finite elements, of small strain or St. Venant-Kirchhoff's, touch by the potential of a pair (docs/method.md). Runs
// are asked for H~ less the work from outside, momentum, J~ = sum x × p - dt/4 sum v^- × p^+ where nothing holds the bodies,
// missed contacts and the force that closes the balance of energy. Solutions at rest are asked for stress and pressure.
// No energy is claimed without H - H~, |e|/m and the number of events beside it. docs/turning.md reads the table.
#include "abut/base/error.hpp"
#include "studies/nodal/rows.hpp"
#include "studies/program/entry.hpp"

namespace abut::studies::turning {
namespace {

const std::vector<Part<Options, Row>> parts{
    {"slipping", "Round bodies that slip off each other, beside what other hosts gave.", run_slipping},
    {"turning", "Bodies that turn: what is kept.", run_turning},
    {"patch", "Blocks on each other at rest: stress is uniform.", solve_patches},
    {"hertz", "Round bodies pressed onto each other: the pressure is Hertz's.", solve_hertz},
    {"edges", "Corners and edges: is a corner pushed aside, do edges rebound?", run_edges},
    {"steps", "How far may the advised step be exceeded?", sweep_steps},
    {"long", "A disc between rigid walls, for very many steps.", run_long}};

const apps::Program program{
    .name = "turning",
    .purpose = "Contact on nodes, of bodies that turn: energies, momenta, patch tests, Hertz, corners, time steps.",
    .footer = "A target that is missed is said to be; the exit code is that of the program alone."};

void add_options(Flags& flags, Options& options) {
    add_part_options(flags, program, names_of(parts), options);
    flags.group("Time");
    flags.choice("--scheme", options.run.integrator, "of the runs in which it is not compared",
                 apps::Choices<Scheme>{{"memm", Scheme::memm}, {"leapfrog", Scheme::leapfrog}});
    flags.flag("--filter", options.run.filter, "take the alternating mode of memm out of what touches");
    flags.count("--restart", options.run.restart, "steps of memm from one neutral restart to the next; 0: none", 0);
    flags.number("--cfl", options.run.cfl, "time step over the advised one", {.above = 0.0});
    flags.count("--steps", options.long_steps, "of the long runs", 1);
    flags.group("Output");
    flags.count("--frames", options.run.frames, "for ParaView, of each run; 0: none", 0);
}

void run(const Options& options) {
    if (options.run.integrator == Scheme::leapfrog && (options.run.filter || options.run.restart > 0))
        throw BadInput(
            "--scheme leapfrog: filter and restart are made for memm, which has the mode they take out. Leave "
            "--filter and --restart out.");
    const run::NamedValues used{{"only", options.only},         {"scheme", dynamics::name_of(options.run.integrator)},
                                {"filter", options.run.filter}, {"restart", options.run.restart},
                                {"cfl", options.run.cfl},       {"steps", options.long_steps},
                                {"quick", options.quick}};
    run_study_in_parts(program, parts, options, used, {22, 30, 8, {"correction_max", "seconds", "seconds_of_steps"}});
}

const bool is_listed = list(entry_of(program, Options{}, add_options, run));

}  // namespace

}  // namespace abut::studies::turning
