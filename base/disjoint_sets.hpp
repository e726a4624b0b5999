#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace abut {

/// Sets of the numbers 0 .. n-1 that grow together, each number alone at first. A set is known by its smallest member, so
/// that what is found does not depend on the order in which sets were joined.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

    /// The smallest member of the set of i.
    [[nodiscard]] std::int32_t find(std::int32_t i) {
        while (up(i) != i) i = up(i) = up(up(i));  // halves the path for those who come later
        return i;
    }
    void join(std::int32_t i, std::int32_t j) {
        i = find(i), j = find(j);
        up(std::max(i, j)) = std::min(i, j);
    }

private:
    std::int32_t& up(std::int32_t i) { return parent_[static_cast<std::size_t>(i)]; }

    std::vector<std::int32_t> parent_;
};

}  // namespace abut
