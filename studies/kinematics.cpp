// Bodies that turn, however they move: small, floating, finite or rigid. What each keeps, where it is right, and what it costs.
//
// Cell-centred elasticity and rigid bodies touch by the potential of a pair (docs/method.md). Runs are asked for H~ less the
// work from outside, momentum, J~ = sum x × p - dt/4 sum v^- × p^+ where nothing holds the bodies, missed contacts and the
// force that closes the balance of energy; scenes are asked for closed forms: tops, times of impact, Hertz, a cradle, gears. No
// energy is claimed without H - H~, |e|/m and the number of events beside it.
#include "abut/run/files.hpp"
#include "abut/run/folder_lock.hpp"
#include "studies/kinematics/rows.hpp"
#include "studies/program/entry.hpp"

namespace abut::studies::kinematics {

const std::vector<Part>& parts() {
    static const std::vector<Part> all{
        {"free", "Blocks that spin freely: do they keep their size?", run_free},
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
        {"pile", "Polygons in a box under gravity; and what rigid bodies cost.", run_pile},
    };
    return all;
}

namespace {

const apps::Program program{
    .name = "kinematics",
    .purpose = "Small, floating, finite and rigid bodies: energies, momenta, closed forms, and what they cost.",
    .footer = "A target that is missed is said to be; the exit code is that of the program alone."};

void add_options(Flags& flags, Options& options) {
    std::vector<std::string> names;
    for (const Part& part : parts()) names.push_back(part.name);
    add_part_options(flags, program, names, options);
    flags.group("Time");
    flags.count("--steps", options.steps, "of the pile", 1);
    flags.count("--turns", options.turns, "of the first gear", 1);
    flags.group("Output");
    flags.count("--frames", options.frames, "for ParaView, of each run; 0: none", 0);
}

void run(const Options& options) {
    const run::FolderLock lock(options.out, program.name);
    run::claim_results(options.out, {"summary.json", program.name + ".csv"});
    std::vector<Row> rows;
    for (const Part& part : parts()) {
        if (!options.asks_for(part.name)) continue;
        print_head(part);
        part.run(options, [&](const Row& row) {
            print(row);
            rows.push_back(row);
        });
    }
    write_report(program, options, rows);
}

}  // namespace

Entry entry() { return entry_of(program, Options{}, add_options, run); }

}  // namespace abut::studies::kinematics
