#pragma once
#include <nlohmann/json_fwd.hpp>

#include "apps/detect/detection.hpp"
#include "apps/detect/verification.hpp"

namespace abut::apps {

/// Times of the parts of a run [s].
struct DetectTimes {
    ReadingTimes input;
    double setup = 0.0, motion = 0.0, search = 0.0, narrow = 0.0, nearest = 0.0, verification = 0.0, writing = 0.0;
};

/// Everything that a run has to say.
struct DetectReport {
    const Bodies& bodies;
    const Nearness& near;
    int steps = 0;         ///< taken after the start
    bool complete = true;  ///< false: a signal ended the run before its last step
    double skin = 0.0;     ///< of the last list [m]
    StepResult last;
    contact::CandidateReport search;
    geometry::DecisionCounts decided;  ///< over all steps
    std::int64_t overlaps_max = 0;     ///< in one step
    bool verified = false;
    Verification verification;
    DetectTimes seconds;
};

[[nodiscard]] nlohmann::ordered_json summary(const DetectReport& report, const DetectOptions& options);
void print(const DetectReport& report, const DetectOptions& options);

}  // namespace abut::apps
