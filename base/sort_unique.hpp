#pragma once
// Private to the sources of the layers.
#include <algorithm>
#include <vector>

namespace abut {

/// Increasing, each value once.
template <class T>
void sort_unique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace abut
