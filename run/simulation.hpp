#pragma once
#include "abut/run/observer.hpp"
#include "abut/run/options.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {

/// Runs a scene from its first step to its last. It writes and prints nothing: observers do (ResultFiles, Frames, EnergyFile).
/// The result lacks the times of mesh and output, which others know. `Scene::after_step` is called before the observers.
///
/// An observer that asks to stop ends the run after its present step, or before the first one: that step is recorded as the
/// last one, and all figures of the result are those until then; RunResult::complete is false if steps were left.
///
/// Throws BadInput with place, value, limit and remedy for options that do not go together, for bodies that overlap where the
/// scene has contact, for a time step above the stable one, and where nothing moves and no `energy_scale` is given. An error
/// within a step says in front of its text which step and time it was, and keeps its kind and facts, as the type of that kind:
/// Diverged, TooDeep and whatever else solid::Solid throws.
///
/// `from`: the run goes on after this checkpoint, which an observer of the same scene under the same options has kept, with
/// the same observers; the rest has the bits that it would have had, and so do the ledger and what observers write. Throws
/// BadInput for one of other options, sizes, masses or steps; functions of a scene (paths, loads) are taken to be the same.
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options, Observer<Dim>& observer,
                                      const Checkpoint* from = nullptr);
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options = {}) {
    Observer<Dim> nobody;
    return simulate<Dim>(scene, options, nobody);
}

}  // namespace abut::run
