#pragma once
// Private to the layer.
#include <algorithm>
#include <cstdint>

#include "abut/contact/report.hpp"
#include "abut/contact/step.hpp"

namespace abut::contact {

/// Adds what a step did, friction apart.
template <class Step>
void count_step(ContactReport& report, const Step& step, double compression_warning) {
    const StepReport& of_step = step.report;
    report.active_pairs = static_cast<std::int64_t>(step.pairs.size());
    report.active_pairs_max = std::max(report.active_pairs_max, report.active_pairs);
    report.events += of_step.events;
    report.compression_max = std::max(report.compression_max, of_step.compression);
    report.sliding_ratio_max = std::max(report.sliding_ratio_max, of_step.sliding_ratio);
    report.slipped_pairs += of_step.slipped_pairs;
    report.slipped_compression_max = std::max(report.slipped_compression_max, of_step.slipped_compression);
    report.tilted_pairs_max = std::max(report.tilted_pairs_max, of_step.tilted_pairs);
    report.correction_max = std::max(report.correction_max, of_step.correction);
    if (of_step.compression > compression_warning) ++report.compressed_steps;
}

/// Adds the friction of a step of `dt` [s] that is not refused.
inline void count_friction(ContactReport& report, const FrictionFigures& friction, double dt) {
    report.friction_dissipated += friction.dissipated;
    report.least_dissipated = std::min(report.least_dissipated, friction.least_dissipated);
    report.friction_ratio_max = std::max(report.friction_ratio_max, friction.largest_ratio);
    report.sliding_force += dt * friction.sliding_force;
    report.sliding_limit += dt * friction.sliding_limit;
    report.sticking_faces = friction.sticking;
    report.sliding_faces = friction.sliding;
    report.sticking_faces_max = std::max(report.sticking_faces_max, friction.sticking);
    report.sliding_faces_max = std::max(report.sliding_faces_max, friction.sliding);
}

}  // namespace abut::contact
