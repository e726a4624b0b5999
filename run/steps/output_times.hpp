#pragma once
// Private to the layer.
#include <span>

#include "abut/run/values/forward.hpp"

namespace abut::run {

struct RunOptions;

/// Throws BadInput unless times of frames increase from 0 or more to the end of the run at most [s], and go with the scheme
/// and the files (solid::combinations).
void check_output_times(std::span<const double> times, const RunOptions& options, double end);

}  // namespace abut::run
