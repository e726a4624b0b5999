#pragma once
// Private to the layer.
#include <cstdint>

namespace abut::run {

/// Wishes of the observer of rank 0 after a step, or before the first one, as one number that all ranks are told.
struct Wanted {
    bool stop = false;
    bool see = false;
    bool look = false;  ///< at the solid itself
    bool checkpoint = false;
    bool measure = false;     ///< the surfaces
    std::int64_t piece = -1;  ///< of this frame

    [[nodiscard]] std::int64_t as_number() const {
        return (piece + 1) * 32 + (stop ? 1 : 0) + (see ? 2 : 0) + (look ? 4 : 0) + (checkpoint ? 8 : 0) +
               (measure ? 16 : 0);
    }
    [[nodiscard]] static Wanted of(std::int64_t number) {
        return {.stop = (number & 1) != 0,
                .see = (number & 2) != 0,
                .look = (number & 4) != 0,
                .checkpoint = (number & 8) != 0,
                .measure = (number & 16) != 0,
                .piece = number / 32 - 1};
    }
};

}  // namespace abut::run
