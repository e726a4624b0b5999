#pragma once
// Private to the sources of the layers.
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {
namespace detail {

/// Like `sort_unique`, by a mark for each number from `least` on, in time that is linear in `range` and the values: one bit
/// each beside the result.
template <std::integral T>
std::vector<T> marked(const std::vector<T>& values, T least, std::size_t range) {
    std::vector<std::uint64_t> marks(range / 64 + 1, 0);
    for (const T value : values) {
        const auto i = static_cast<std::size_t>(static_cast<std::int64_t>(value) - least);
        marks[i / 64] |= std::uint64_t{1} << i % 64;
    }
    std::size_t count = 0;
    for (const std::uint64_t word : marks) count += static_cast<std::size_t>(std::popcount(word));
    std::vector<T> result;
    result.reserve(count);
    for (std::size_t k = 0; k < marks.size(); ++k)
        for (std::uint64_t word = marks[k]; word != 0; word &= word - 1)
            result.push_back(static_cast<T>(least + static_cast<std::int64_t>(64 * k) + std::countr_zero(word)));
    return result;
}

}  // namespace detail

/// Increasing, each value once.
template <class T>
void sort_unique(std::vector<T>& values) {
    if constexpr (std::same_as<T, std::int32_t>) {
        constexpr std::size_t worth_marks = 1000;
        if (values.size() > worth_marks) {
            const auto [least, most] = std::minmax_element(values.begin(), values.end());
            const auto range = static_cast<std::size_t>(static_cast<std::int64_t>(*most) - *least) + 1;
            if (range / 64 <= values.size()) {
                values = detail::marked(values, *least, range);
                return;
            }
        }
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace abut
