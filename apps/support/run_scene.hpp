#pragma once
#include "apps/support/program.hpp"
#include "apps/support/run_options.hpp"
#include "apps/support/scene_of_rank.hpp"

namespace abut::apps {

/// The body of a program that runs a scene: makes it, runs it with log and progress or as `program.messages` has it,
/// leaves the files of run::ResultFiles in `options.out` and prints the closing table. Results of an earlier run there
/// are removed before options are checked together and the scene is made. Throws std::exception with place, value,
/// limit and remedy: folder not writable or taken by another run, unusable mesh, bodies that overlap, time step above
/// the stable one, divergence. No energy.csv and no summary.json is left then. From when the scene is made on, SIGINT,
/// SIGTERM and SIGHUP end the run after its present step, and all files are finished: "complete" is false in
/// summary.json, and run_program returns 130, 143 or 129. A pipe that nobody reads any more does not end it. A second
/// signal ends the process at once.
template <int Dim>
void run_scene(const Program& program, const run::RunOptions& options, const MakeScene<Dim>& make_scene);

}  // namespace abut::apps
