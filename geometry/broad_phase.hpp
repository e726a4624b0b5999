#pragma once
#include <compare>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "abut/geometry/box.hpp"

namespace abut::geometry {

/// What finds the pairs of boxes that overlap: one of two trees, or a double loop. The answers are identical; the cost
/// differs.
enum class BroadPhase {
    embree,       ///< rtcCollide over user boxes (single precision inside, re-tested in double)
    fcl,          ///< FCL's dynamic AABB tree
    brute_force,  ///< every box against every box: the oracle
};

struct IndexPair {
    std::int32_t first;
    std::int32_t second;
    friend auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

/// All (i, j) for which boxes_1[i] and boxes_2[j] overlap (closed test, in double), sorted, each once. Empty boxes overlap
/// nothing. Throws std::invalid_argument naming the box if a bound is NaN or infinite (an empty box excepted).
template <int Dim>
[[nodiscard]] std::vector<IndexPair> overlapping_pairs(BroadPhase method, std::span<const Box<Dim>> boxes_1,
                                                       std::span<const Box<Dim>> boxes_2);

/// All (i, j), i < j, for which two boxes of one set overlap; sorted, each once. Errors as above.
template <int Dim>
[[nodiscard]] std::vector<IndexPair> overlapping_pairs(BroadPhase method, std::span<const Box<Dim>> boxes);

/// "embree", "fcl", "brute_force".
[[nodiscard]] std::string_view name(BroadPhase method);

}  // namespace abut::geometry
