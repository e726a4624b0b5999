#include "abut/geometry/broad_phase/backends.hpp"

namespace abut::geometry::backend {

void find_by_brute_force(Boxes boxes_1, Boxes boxes_2, FoundPairs& found) {
    FoundPairs::Local& mine = found.local();
    for (std::size_t i = 0; i < boxes_1.size() && !mine.too_many(); ++i)
        for (std::size_t j = 0; j < boxes_2.size(); ++j)
            if (boxes_1[i].overlaps(boxes_2[j])) mine.add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
}

void find_by_brute_force(Boxes boxes, FoundPairs& found) {
    FoundPairs::Local& mine = found.local();
    for (std::size_t i = 0; i < boxes.size() && !mine.too_many(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j)
            if (boxes[i].overlaps(boxes[j])) mine.add(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
}

}  // namespace abut::geometry::backend
