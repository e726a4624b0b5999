#pragma once
// Private to the sources of the layers.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "abut/base/parallel.hpp"
#include "abut/base/sort_unique.hpp"
#include "abut/geometry/broad_phase/broad_phase.hpp"

namespace abut::geometry {

/// The n pairs that `for_each(use)` hands to `use`, the same each time it is called: sorted, each once. Their `first` lies
/// in [0, n_first). Rows are counted, then each is sorted: n_first + n log (pairs per row).
template <class ForEach>
[[nodiscard]] std::vector<IndexPair> sorted_pairs(std::size_t n, std::size_t n_first, const ForEach& for_each) {
    std::vector<IndexPair> pairs(n);
    constexpr std::size_t rows_per_pair = 8;  // with fewer pairs than one in so many rows a general sort costs less
    if (rows_per_pair * n < n_first) {
        auto next = pairs.begin();
        for_each([&](const IndexPair& pair) { *next++ = pair; });
        sort_unique(pairs);
        return pairs;
    }
    std::vector<std::uint32_t> end(n_first + 1, 0);  // of each row, once its pairs are in place
    for_each([&](const IndexPair& pair) { ++end[static_cast<std::size_t>(pair.first) + 1]; });
    for (std::size_t row = 0; row < n_first; ++row) end[row + 1] += end[row];
    for_each([&](const IndexPair& pair) { pairs[end[static_cast<std::size_t>(pair.first)]++] = pair; });
    parallel_parts(n_first, 4096, [&](std::size_t first_row, std::size_t last_row) {
        for (std::size_t row = first_row; row < last_row; ++row)
            std::sort(pairs.begin() + (row == 0 ? 0 : end[row - 1]), pairs.begin() + end[row]);
    });
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// Sorts pairs whose `first` lies in [0, n_first), each once.
inline void sort_pairs(std::vector<IndexPair>& pairs, std::size_t n_first) {
    pairs = sorted_pairs(pairs.size(), n_first, [&](const auto& use) {
        for (const IndexPair& pair : pairs) use(pair);
    });
}

}  // namespace abut::geometry
