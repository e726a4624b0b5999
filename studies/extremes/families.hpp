#pragma once
#include "studies/extremes/trial.hpp"
#include "studies/table/table.hpp"

namespace abut::studies::extremes {

/// Options of the sweeps.
struct SweepOptions {
    int steps = 100'000;  ///< of the long runs
    bool quick = false;   ///< fewer values a family, and no more than 2,000 steps in a long run
    run::RunOptions run;  ///< cfl and choices of contact of all runs that do not sweep them
};

using Sink = std::function<void(const Row&)>;
/// Runs that take one number of a scene to its extremes.
using Family = Part<SweepOptions, Row>;
[[nodiscard]] const std::vector<Family>& families();

/// `values`, or of these the first, the middle and the last one.
[[nodiscard]] std::vector<double> thinned(const std::vector<double>& values, bool quick);

// The sweeps, each in the file of its subject.
void sweep_units(const SweepOptions& options, const Sink& sink);
void sweep_offset(const SweepOptions& options, const Sink& sink);
void sweep_stiffness(const SweepOptions& options, const Sink& sink);
void sweep_density(const SweepOptions& options, const Sink& sink);
void sweep_poisson(const SweepOptions& options, const Sink& sink);
void sweep_speed(const SweepOptions& options, const Sink& sink);
void sweep_cfl(const SweepOptions& options, const Sink& sink);
void sweep_aspect(const SweepOptions& options, const Sink& sink);
void sweep_refinement(const SweepOptions& options, const Sink& sink);
void sweep_thickness(const SweepOptions& options, const Sink& sink);
void sweep_wedge(const SweepOptions& options, const Sink& sink);
void sweep_corner(const SweepOptions& options, const Sink& sink);
void sweep_crossing(const SweepOptions& options, const Sink& sink);
void sweep_spin(const SweepOptions& options, const Sink& sink);
void sweep_rim(const SweepOptions& options, const Sink& sink);
void sweep_turns(const SweepOptions& options, const Sink& sink);
void sweep_sizes(const SweepOptions& options, const Sink& sink);
void sweep_masses(const SweepOptions& options, const Sink& sink);
void sweep_rollers(const SweepOptions& options, const Sink& sink);
void sweep_edge(const SweepOptions& options, const Sink& sink);
void sweep_crowd(const SweepOptions& options, const Sink& sink);
void sweep_long(const SweepOptions& options, const Sink& sink);
void sweep_rest(const SweepOptions& options, const Sink& sink);

}  // namespace abut::studies::extremes
