#pragma once
#include "apps/detect/options.hpp"

namespace abut::apps {

/// The body of `abut detect`: reads and judges the bodies, moves them step by step, finds what
/// is near, and leaves and prints what was found. Throws std::exception with place, value, limit and remedy; also where
/// --verify finds something missed. SIGINT, SIGTERM and SIGHUP end it after its present step.
void detect(const DetectOptions& options);

}  // namespace abut::apps
