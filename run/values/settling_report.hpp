#pragma once
#include <cstdint>

namespace abut::run {

/// How bodies came to rest before a run (RunOptions::settle).
struct SettlingReport {
    std::int64_t steps = 0;
    std::int64_t rests = 0;   ///< times that all velocities were set to 0
    double dissipated = 0.0;  ///< by friction, until then [J]
    double speed = 0.0;       ///< largest of a point that was left when the velocities were set to 0 for the last time [m/s]
    double seconds = 0.0;
};

}  // namespace abut::run
