#pragma once
// Private to the layer.
#include <cstdint>

namespace abut::run {

/// Wishes of the observer of rank 0 after a step, or before the first one, as one number that all ranks are told.
struct Wanted {
    bool stop = false;
    bool look = false;
    bool checkpoint = false;
    bool measure = false;     ///< the surfaces
    std::int64_t piece = -1;  ///< of this frame

    [[nodiscard]] std::int64_t as_number() const {
        return (piece + 1) * 16 + (stop ? 1 : 0) + (look ? 2 : 0) + (checkpoint ? 4 : 0) + (measure ? 8 : 0);
    }
    [[nodiscard]] static Wanted of(std::int64_t number) {
        return {(number & 1) != 0, (number & 2) != 0, (number & 4) != 0, (number & 8) != 0, number / 16 - 1};
    }
};

}  // namespace abut::run
