#pragma once
// Private to the sources of this layer.
#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "abut/contact/interference.hpp"
#include "abut/solid/contact/face_sides.hpp"
#include "abut/solid/options/options.hpp"

namespace abut::solid {

/// Overlaps at the start as contact asks for them, by face; of several for two faces that with more groups counts, then
/// the first. `body_of` as FaceSides,
/// `faces_of(g)` as there.
template <int Dim, class FacesOf>
[[nodiscard]] contact::InterferenceOptions interference_between(const SolidOptions<Dim>& options, std::int32_t n_bodies,
                                                                std::vector<std::int32_t> body_of, const FacesOf& faces_of) {
    if (options.interference.empty()) return {};
    contact::InterferenceOptions interference;
    FaceSides sides(std::move(body_of), n_bodies + static_cast<std::int32_t>(options.obstacles.size()));
    struct OfSides {
        std::array<std::int32_t, 2> sides;
        std::int32_t number;
        int n_groups = 0;
    };
    std::vector<OfSides> of_sides;
    for (const auto& [pair, time] : options.interference) {
        of_sides.push_back({.sides = pair, .number = static_cast<std::int32_t>(interference.times.size())});
        interference.times.push_back(time);
        for (const std::int32_t side : pair) {
            sides.add(side, faces_of);
            of_sides.back().n_groups += sides.is_group(side) ? 1 : 0;
        }
    }
    std::ranges::stable_sort(of_sides, std::ranges::greater{}, &OfSides::n_groups);
    interference.of = [sides = std::move(sides), of_sides = std::move(of_sides)](contact::Face face_1,
                                                                                 contact::Face face_2) {
        for (const OfSides& one : of_sides)
            if ((sides.has(one.sides[0], face_1) && sides.has(one.sides[1], face_2)) ||
                (sides.has(one.sides[0], face_2) && sides.has(one.sides[1], face_1)))
                return one.number;
        return -1;
    };
    return interference;
}

}  // namespace abut::solid
