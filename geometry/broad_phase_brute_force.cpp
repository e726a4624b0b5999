#include "abut/geometry/broad_phase_backends.hpp"

namespace abut::geometry::backend {

std::vector<IndexPair> brute_force_pairs(Boxes boxes_1, Boxes boxes_2) {
    std::vector<IndexPair> pairs;
    for (std::size_t i = 0; i < boxes_1.size(); ++i)
        for (std::size_t j = 0; j < boxes_2.size(); ++j)
            if (boxes_1[i].overlaps(boxes_2[j]))
                pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    return pairs;
}

std::vector<IndexPair> brute_force_pairs(Boxes boxes) {
    std::vector<IndexPair> pairs;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j)
            if (boxes[i].overlaps(boxes[j])) pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    return pairs;
}

}  // namespace abut::geometry::backend
