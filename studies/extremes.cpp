// Where the method ends: one number of a scene at a time is taken to its extremes, and each run is held to the laws that it
// must obey whatever the number is.
//
// A run `held` when it came to its end with finite numbers, H~ and linear momentum kept to 1e-10 of their scale, H - H~
// below the energy of the run, and no contact missed. It is `refused` when it ended with a message, which then says what is
// allowed; it `failed` when it came to its end and one of these is not so. A change of units must leave every number
// without a unit as it is, to 1e-9. No energy is claimed without H - H~, |e|/m and the number of events beside it.
#include "apps/support/run_options.hpp"
#include "studies/extremes/families.hpp"
#include "studies/extremes/report.hpp"
#include "studies/program/entry.hpp"

namespace abut::studies::extremes {
namespace {

const apps::Program program{
    .name = "extremes",
    .purpose = "Units, stiffness, density, speed, meshes, time steps and more, taken to their extremes.",
    .footer = "A run held, was refused with a message, or failed: the head of the source says what is asked."};

struct Options {
    std::vector<std::string> only;
    SweepOptions sweep{.run = {.out = "out/" + program.name}};
};

void add_options(Flags& flags, Options& options) {
    flags.group("Sweeps");
    flags.names("--only", options.only, "families to sweep", names_of(families()));
    flags.count("--steps", options.sweep.steps, "steps of the families long and rest", 1);
    flags.flag("--quick", options.sweep.quick, "fewer values of each family, and at most 2,000 steps of a long run");
    flags.group("Time");
    flags.number("--cfl", options.sweep.run.cfl, "time step over the stable step, where it is not swept",
                 {.above = 0.0, .below = 1.0, .closed = true});
    apps::add_contact_options(flags, options.sweep.run);
    flags.out(options.sweep.run.out);
}

void sweep(const Options& options) {
    const run::FolderLock lock(options.sweep.run.out, program.name);
    run::claim_results(options.sweep.run.out, {"extremes.csv", "summary.json"});
    const auto rows = run_parts<SweepOptions, Row>(families(), options.only, options.sweep, table_heads(), print);
    write_report(program, options.sweep.run.out, options.sweep, rows);
}

const bool is_listed = list(entry_of(program, Options{}, add_options, sweep));

}  // namespace

}  // namespace abut::studies::extremes
