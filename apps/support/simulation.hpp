#pragma once
#include "apps/support/run.hpp"

namespace abut::examples {

/// Looks on while a scene is run; by itself nothing.
template <int Dim>
class Observer {
public:
    virtual ~Observer() = default;
    /// All is set up, no step is taken.
    virtual void begin(const Scene<Dim>&, const RunResult<Dim>&) {}
    virtual void record(const dynamics::LedgerEntry<Dim>&, const RunResult<Dim>&) {}
    virtual void look(const dynamics::RunView<Dim>&, solid::Solid<Dim>&) {}  ///< at the start and after each step
};

/// What of the options depends on the dimension, and on nothing else, is filled in.
template <int Dim>
[[nodiscard]] RunOptions with_defaults(RunOptions options);

/// Throws BadInput if options do not go together.
void check(const RunOptions& options);

/// Runs a scene from its first step to its last and writes nothing: time and skin of the result are known, the times of
/// mesh and output are not. Throws std::exception with place, value, limit and remedy: bodies that overlap, time step above
/// the stable one, divergence.
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options, Observer<Dim>& observer);
template <int Dim>
[[nodiscard]] RunResult<Dim> simulate(const Scene<Dim>& scene, const RunOptions& options) {
    Observer<Dim> nobody;
    return simulate<Dim>(scene, options, nobody);
}

}  // namespace abut::examples
