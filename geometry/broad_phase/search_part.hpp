#pragma once
// Private to the sources of the layers.
#include <span>
#include <vector>

#include "abut/geometry/broad_phase/broad_phase.hpp"

namespace abut::geometry {

/// Throws BadInput for a method that there is not, or a negative number of pairs.
void check_options(const SearchOptions& options);

/// One of several parts of a search, for processes that share it: each pair is found by one part.
struct SearchPart {
    int part = 0;  ///< from 0
    int n_parts = 1;
};

/// The pairs of `overlapping_pairs` that are found by this part, in the numbers of all boxes: of a contiguous range of
/// boxes_1 with as many boxes in each part that can overlap something. Sorted; throws as `overlapping_pairs`, limits are
/// those of a part.
template <int Dim>
[[nodiscard]] std::vector<IndexPair> overlapping_pairs_of_part(const SearchPart& part, const SearchOptions& options,
                                                               std::span<const Box<Dim>> boxes_1,
                                                               std::span<const Box<Dim>> boxes_2, const PairFilter& wanted);

/// Same search within one set, in any order: pairs within a contiguous range of it, and every other one of the pairs that
/// this range has with boxes outside.
template <int Dim>
[[nodiscard]] std::vector<IndexPair> overlapping_pairs_of_part(const SearchPart& part, const SearchOptions& options,
                                                               std::span<const Box<Dim>> boxes, const PairFilter& wanted);

}  // namespace abut::geometry
