#pragma once
#include "abut/run/observer.hpp"
#include "abut/run/options.hpp"
#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"
#include "abut/run/steps/share.hpp"
#include "abut/run/values/checkpoint.hpp"
#include "abut/run/values/failure.hpp"
#include "abut/run/values/frame_piece.hpp"

namespace abut::run {

/// Runs a scene from its first step to its last. It writes and prints nothing: observers do (ResultFiles, Frames,
/// EnergyFile). The result lacks the times of mesh and output, which others know. `Scene::after_step` is called before
/// the observers.
///
/// An observer that asks to stop ends the run after its present step, or before the first one: that step is recorded as the
/// last one, and all figures of the result are those until then; RunSteps::complete is false if steps were left.
///
/// Throws BadInput with place, value, limit and remedy for options that do not go together, for bodies that overlap
/// where the scene has contact, and for a time step above the stable one. An error within a step says in front of its
/// text which step and time it was, and keeps its kind and facts, as the type of that kind: Diverged, TooDeep and
/// whatever else solid::Solid throws. A run has diverged, too, where H - H~ exceeds the energy in play
/// (Accounts::energy_in_play).
///
/// `from`: the run goes on after this checkpoint, which an observer of the same scene under the same options has kept, with
/// the same observers; the rest has the bits that it would have had, and so do the ledger and what observers write. Throws
/// BadInput for one of other options, sizes, masses or steps; functions of a scene (paths, loads) are taken to be the same.
/// `share`: several ranks run the scene together, each with its share, and all call this. What comes out has the bits of one
/// rank, whatever their number: the result (but times, and what is of the whole mesh, that is complete on rank 0 alone:
/// motion of the bodies, stencils, findings), what the observer of rank 0 sees, checkpoints, which may go from one
/// number of ranks to another. Throws BadInput on all for what is not made for several ranks (docs/ranks.md), and where
/// one of them has an error.
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options, Observer<Dim>& observer,
                                      const Checkpoint* from = nullptr, const Share<Dim>* share = nullptr);
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options = {}) {
    Observer<Dim> nobody;
    return simulate<Dim>(scene, options, nobody);
}

}  // namespace abut::run
