#pragma once
// Private to the sources of run.
#include <string>

#include "abut/run/result.hpp"
#include "abut/run/scene.hpp"

namespace abut::run {

/// Identity of a run: all that its rest depends on beside its state, as JSON: sizes, step and end, the options of scene
/// and run.
template <int Dim>
[[nodiscard]] std::string identity(const Scene<Dim>& scene, const RunResult<Dim>& result);

/// Steps between the records of a saved run; 0 where it does not say so.
[[nodiscard]] int recorded_interval(const std::string& saved);

/// Throws BadInput naming what a saved run had and this one has not; with `other_end` its number of steps may be another.
void require_same_run(const std::string& saved, const std::string& now, bool other_end);

}  // namespace abut::run
