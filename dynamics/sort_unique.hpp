#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <cstdint>
#include <vector>

namespace abut::dynamics {

inline void sort_unique(std::vector<std::int32_t>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace abut::dynamics
