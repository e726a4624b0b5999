#pragma once
#include "abut/run/observer.hpp"
#include "abut/run/options.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {

/// Runs a scene from its first step to its last. It writes and prints nothing: observers do (ResultFiles, Frames,
/// EnergyFile). All of the result is known except the times of mesh and output. Of the scene, `after_step` is called before
/// the observers.
///
/// Throws BadInput with place, value, limit and remedy for options that do not go together or bodies that overlap, for a
/// time step above the stable one, and where nothing moves and no `energy_scale` is given. An error within a step says in
/// front of its text which step and time it was, and keeps its type, kind and facts: Diverged, TooDeep and what
/// solid::Solid throws else.
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options, Observer<Dim>& observer);
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options = {}) {
    Observer<Dim> nobody;
    return simulate<Dim>(scene, options, nobody);
}

}  // namespace abut::run
