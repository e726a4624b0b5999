#include "abut/geometry/broad_phase/search_part.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace abut::geometry {
namespace {

/// Index at which a part of n things begins; the end of the last part is n.
std::size_t begin_of(std::size_t n, int part, int n_parts) {
    return n * static_cast<std::size_t>(part) / static_cast<std::size_t>(n_parts);
}

template <int Dim>
bool can_meet(const Box<Dim>& region, const Box<Dim>& box) {
    return box.overlaps(region) && !box.empty();
}

/// Index of the box before which there are n that can meet the region.
template <int Dim>
std::size_t index_after(std::size_t n, const Box<Dim>& region, std::span<const Box<Dim>> boxes) {
    std::size_t i = 0;
    for (; n > 0; ++i) n -= can_meet(region, boxes[i]) ? 1 : 0;
    return i;
}

PairFilter with_first_from(std::size_t begin, const PairFilter& wanted) {
    if (!wanted) return {};
    return
        [&wanted, begin = static_cast<std::int32_t>(begin)](std::int32_t i, std::int32_t j) { return wanted(begin + i, j); };
}

}  // namespace

template <int Dim>
std::vector<IndexPair> overlapping_pairs_of_part(const SearchPart& part, const SearchOptions& options,
                                                 std::span<const Box<Dim>> boxes_1, std::span<const Box<Dim>> boxes_2,
                                                 const PairFilter& wanted) {
    if (part.n_parts == 1) return overlapping_pairs<Dim>(options, boxes_1, boxes_2, wanted);
    const Box<Dim> region = bounding_box<Dim>(boxes_2);
    const auto n =
        static_cast<std::size_t>(std::ranges::count_if(boxes_1, [&](const auto& box) { return can_meet(region, box); }));
    const std::size_t begin = index_after(begin_of(n, part.part, part.n_parts), region, boxes_1);
    const std::size_t end = index_after(begin_of(n, part.part + 1, part.n_parts), region, boxes_1);
    auto pairs =
        overlapping_pairs<Dim>(options, boxes_1.subspan(begin, end - begin), boxes_2, with_first_from(begin, wanted));
    for (IndexPair& pair : pairs) pair.first += static_cast<std::int32_t>(begin);
    return pairs;
}

template <int Dim>
std::vector<IndexPair> overlapping_pairs_of_part(const SearchPart& part, const SearchOptions& options,
                                                 std::span<const Box<Dim>> boxes, const PairFilter& wanted) {
    if (part.n_parts == 1) return overlapping_pairs<Dim>(options, boxes, wanted);
    const std::size_t first = begin_of(boxes.size(), part.part, part.n_parts);
    const std::size_t last = begin_of(boxes.size(), part.part + 1, part.n_parts);
    const auto begin = static_cast<std::int32_t>(first);
    const auto mine = boxes.subspan(first, last - first);
    auto pairs = overlapping_pairs<Dim>(
        options, mine,
        !wanted ? PairFilter{} : [&](std::int32_t i, std::int32_t j) { return wanted(begin + i, begin + j); });
    for (IndexPair& pair : pairs) pair = {begin + pair.first, begin + pair.second};
    const std::array<std::array<std::size_t, 2>, 2> outside{{{0, first}, {last, boxes.size()}}};
    for (const auto& [from, to] : outside) {
        SearchOptions left = options;
        left.limits.pairs -= static_cast<std::int64_t>(pairs.size());
        // The parts of both boxes find the pair: one keeps those of even and odd numbers, the other one the rest.
        const auto in_order = [&, offset = static_cast<std::int32_t>(from)](std::int32_t i, std::int32_t j) {
            const auto [a, b] = std::minmax({begin + i, offset + j});
            return IndexPair{a, b};
        };
        const PairFilter keeps = [&](std::int32_t i, std::int32_t j) {
            const auto [a, b] = in_order(i, j);
            const bool are_alike = ((a ^ b) & 1) == 0;
            return are_alike == (a == begin + i) && (!wanted || wanted(a, b));
        };
        for (const auto& [i, j] : overlapping_pairs<Dim>(left, mine, boxes.subspan(from, to - from), keeps))
            pairs.push_back(in_order(i, j));
    }
    return pairs;
}

#define ABUT_INSTANTIATE(Dim)                                                                                              \
    template std::vector<IndexPair> overlapping_pairs_of_part<Dim>(                                                        \
        const SearchPart&, const SearchOptions&, std::span<const Box<Dim>>, std::span<const Box<Dim>>, const PairFilter&); \
    template std::vector<IndexPair> overlapping_pairs_of_part<Dim>(const SearchPart&, const SearchOptions&,                \
                                                                   std::span<const Box<Dim>>, const PairFilter&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::geometry
