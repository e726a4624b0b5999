#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "abut/solid/kinematics/kinematics.hpp"

namespace abut::run {

/// Findings of the pilot run about a body, and the kinematics chosen for it.
struct PilotBody {
    solid::Kinematics picked;
    double rotation;  ///< at most, from its position at rest [rad]
    /// Elastic energy that it takes at most, over the largest kinetic energy of the scene [-]; an estimate:
    /// docs/kinematics.md
    double strain_share;
};

/// Findings that BodyKinematics::automatic rests on.
struct PilotReport {
    std::vector<PilotBody> bodies;  ///< in the order of the mesh
    std::int64_t steps = 0;         ///< of the pilot run
    double seconds = 0.0;           ///< that it took, with the steps timed for the estimates
    /// Time of all steps of the run where all bodies are of one kind, from a few of them [s]; `rigid`: as the pilot run
    /// took; NaN: the scene cannot be run so.
    double small = 0.0;
    double floating = 0.0;
    double rigid = 0.0;

    [[nodiscard]] std::vector<solid::Kinematics> kinematics() const;  ///< SolidOptions::kinematics
};

/// "'left' floating (turns by up to 1.2 rad, takes up to 31 % of the energy)" for each body, and the estimated times.
[[nodiscard]] std::string text_of(const PilotReport& pilot, const std::vector<std::string>& body_names);

}  // namespace abut::run
