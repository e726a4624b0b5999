#include "abut/base/nearest_word.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace abut {
namespace {

using Row = std::vector<std::size_t>;

/// The next row of Levenshtein's table, for one more letter of the first word; a swap of neighbours counts once.
Row next_row(const std::string& a, const std::string& b, std::size_t i, const Row& before, const Row& two_before) {
    Row row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
        row[j] = std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
        if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], two_before[j - 2] + 1);
    }
    return row;
}

std::size_t distance(const std::string& a, const std::string& b) {
    Row two_before, before(b.size() + 1);
    std::iota(before.begin(), before.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        Row row = next_row(a, b, i, before, two_before);
        two_before = std::move(before);
        before = std::move(row);
    }
    return before.back();
}

}  // namespace

std::optional<std::string> nearest_word(const std::string& word, const std::vector<std::string>& known) {
    if (known.empty()) return std::nullopt;
    const auto farness = [&](const std::string& other) {
        return std::pair{distance(word, other), word.end() - std::ranges::mismatch(word, other).in1};
    };
    const auto nearest = std::ranges::min_element(known, {}, farness);
    if (distance(word, *nearest) > (std::max(word.size(), nearest->size()) + 1) / 3) return std::nullopt;
    return *nearest;
}

}  // namespace abut
