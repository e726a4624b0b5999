#pragma once
// Private to the sources of this layer.
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "abut/contact/interference.hpp"
#include "abut/solid/face_sides.hpp"
#include "abut/solid/options.hpp"

namespace abut::solid {

/// Overlaps at the start as contact asks for them, by face; of several for two faces the first counts. `body_of` as FaceSides,
/// `faces_of(g)` as there.
template <int Dim, class FacesOf>
[[nodiscard]] contact::InterferenceOptions interference_between(const SolidOptions<Dim>& options, std::int32_t n_bodies,
                                                                std::vector<std::int32_t> body_of, const FacesOf& faces_of) {
    if (options.interference.empty()) return {};
    contact::InterferenceOptions interference;
    FaceSides sides(std::move(body_of), n_bodies + static_cast<std::int32_t>(options.obstacles.size()));
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const auto& [pair, time] : options.interference) {
        interference.times.push_back(time);
        pairs.push_back(pair);
        for (const std::int32_t side : pair) sides.add(side, faces_of);
    }
    interference.of = [sides = std::move(sides), pairs = std::move(pairs)](contact::Face face_1, contact::Face face_2) {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            if ((sides.has(pairs[i][0], face_1) && sides.has(pairs[i][1], face_2)) ||
                (sides.has(pairs[i][0], face_2) && sides.has(pairs[i][1], face_1)))
                return static_cast<std::int32_t>(i);
        return -1;
    };
    return interference;
}

}  // namespace abut::solid
