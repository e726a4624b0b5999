#pragma once
#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "abut/base/error.hpp"
#include "abut/geometry/box.hpp"

namespace abut::geometry {

/// Methods that find the pairs of boxes that overlap. The answers are identical; the cost differs (docs/detection.md).
enum class BroadPhase {
    automatic,    ///< brute force for a handful of boxes, else the packed tree
    packed_tree,  ///< boxes in the order of a curve through space, packed eight to a block, in double precision
    embree,       ///< rtcCollide over user boxes (single precision inside, re-tested in double)
    fcl,          ///< FCL's dynamic AABB tree
    brute_force,  ///< every box against every box: the oracle
};

/// Methods that this build has: Embree and FCL may be left out where `geometry` is built without `mesh`. A search by another
/// throws BadInput.
[[nodiscard]] std::span<const BroadPhase> broad_phases();

struct IndexPair {
    std::int32_t first;
    std::int32_t second;
    friend auto operator<=>(const IndexPair&, const IndexPair&) = default;
};

/// Limits at which a search gives up with a SearchLimitError.
struct SearchLimits {
    std::int64_t pairs = 250'000'000;  ///< that overlap and are wanted; at most 2^32 - 1
    /// Memory for trees and pairs [bytes], beside the boxes of the caller. That of the trees is estimated before anything is
    /// allocated; pairs count twice, since they are sorted.
    std::size_t bytes = std::numeric_limits<std::size_t>::max();
};

/// A search would take more than its limits allow. Nothing is left behind.
/// `facts().value` is what was known to be needed when the search gave up, in pairs or bytes, as the message says.
struct SearchLimitError : LimitExceeded {
    SearchLimitError(const std::string& what, double needed, double allowed)
        : LimitExceeded(what, {.value = needed, .allowed = allowed}) {}
};

struct SearchOptions {
    BroadPhase method = BroadPhase::automatic;
    SearchLimits limits;
    /// The boxes come in an order in which neighbours are near each other (spatial_order): the packed tree takes them as
    /// they come, which saves most of its building. A promise that does not hold costs time and nothing else.
    bool in_spatial_order = false;
};

/// Decides whether a pair of boxes that overlap is wanted. Called from several threads at once; an empty function wants all.
using PairFilter = std::function<bool(std::int32_t, std::int32_t)>;

/// All (i, j) for which boxes_1[i] and boxes_2[j] overlap (closed test, in double), sorted, each once. Empty boxes overlap
/// nothing, and pairs that `wanted` does not want are left out before anything is kept of them. Throws BadInput
/// naming the box if a bound is NaN or infinite (an empty box excepted), SearchLimitError if there are more pairs, or more
/// memory is needed, than `options.limits` allows.
template <int Dim>
[[nodiscard]] std::vector<IndexPair> overlapping_pairs(const SearchOptions& options, std::span<const Box<Dim>> boxes_1,
                                                       std::span<const Box<Dim>> boxes_2, const PairFilter& wanted = {});

/// All (i, j), i < j, for which two boxes of one set overlap; sorted, each once. Errors as above.
template <int Dim>
[[nodiscard]] std::vector<IndexPair> overlapping_pairs(const SearchOptions& options, std::span<const Box<Dim>> boxes,
                                                       const PairFilter& wanted = {});

/// "automatic", "packed_tree", "embree", "fcl", "brute_force".
[[nodiscard]] std::string_view name(BroadPhase method);

}  // namespace abut::geometry
